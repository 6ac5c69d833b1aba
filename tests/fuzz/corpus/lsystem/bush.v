angle increment: 22.5
initial line width: 0.16 s
line width increment: 0.02
line style: cylinder
