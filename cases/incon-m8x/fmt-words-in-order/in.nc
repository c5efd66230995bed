;plate
n10 x10. g90 g01 f100 ;to the corner
m98 side1 l2
  G1 y5.5(cut)x20.
G91G9G1 X5.
m30
