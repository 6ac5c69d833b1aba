initial line width: 0.12 s
line style: cylinder
