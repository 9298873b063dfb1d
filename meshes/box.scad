// A machined block with a pocket and two counterbored holes. A half turn about z leaves it as it was;
// the half turns about x and y leave the outside as it was and put the pocket underneath.
// Origin: the middle of the block.
size = [ 62, 36, 24 ];
chamfer = 1.5;
top = size.z / 2;

module block()
{
  c = 2 * chamfer;
  hull()
  {
    cube(size - [ c, c, 0 ], center = true);
    cube(size - [ c, 0, c ], center = true);
    cube(size - [ 0, c, c ], center = true);
  }
}

difference()
{
  block();
  // Pocket, 9 deep.
  translate([ 0, 0, top - 9 ]) linear_extrude(10) offset(4, $fn = 32) square([ 16, 12 ], center = true);
  for (x = [ -23, 23 ]) translate([ x, 0, 0 ])
  {
    cylinder(d = 6.5, h = size.z + 2, center = true, $fn = 32);
    translate([ 0, 0, top - 6 ]) cylinder(d = 11, h = 7, $fn = 32);
  }
}
