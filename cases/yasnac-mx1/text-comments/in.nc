(HEAD)
G00 (RAPID) X1. (GO ON, @ # $)
