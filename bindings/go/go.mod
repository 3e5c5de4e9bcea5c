module msq

go 1.19
