G00 X10. (A (B) C)
