m98 Part_1
M30
