// A pipe clip: a saddle over the pipe with a foot at each side, one foot longer and with a slot, the
// other with a hole. No symmetry. Origin: the middle of the pipe, at half the width; feet along x.
width = 22;
inner = 11;
thick = 4;
outer = inner + thick;

module section()
{
  difference()
  {
    union()
    {
      circle(outer, $fn = 64);
      translate([ -outer, -outer ]) square([ 2 * outer, outer ]);
      translate([ -32, -inner ]) square([ 32, thick ]);
      translate([ 0, -inner ]) square([ 42, thick ]);
    }
    circle(inner, $fn = 64);
    translate([ -inner, -2 * outer ]) square([ 2 * inner, 2 * outer ]);
    translate([ -60, -inner - 60 ]) square([ 120, 60 ]);
  }
}

difference()
{
  rotate([ 90, 0, 0 ]) linear_extrude(width, center = true) section();
  translate([ -24, 0, -20 ]) cylinder(d = 7, h = 40, $fn = 32);
  hull() for (x = [ 26, 34 ]) translate([ x, 0, -20 ]) cylinder(d = 6, h = 40, $fn = 32);
}
