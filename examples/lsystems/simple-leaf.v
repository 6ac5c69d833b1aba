angle increment: 60
initial line width: 1 pixels
