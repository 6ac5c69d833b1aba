line style: cylinder
initial line width: 0.14 s
