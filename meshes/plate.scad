// A sheet-metal plate: a flange bent up at one side, holes, a slot and a cut corner. No symmetry.
// Origin: the outer corner of the bend, base in the xy plane, flange along z.
sheet = 2.5;
length = 76;
width = 42;
height = 27;
notch = 7;  // the flange begins this far along y
bend = 2;   // inner radius

// The sheet's section, seen along y.
module section()
{
  difference()
  {
    union()
    {
      translate([ bend + sheet, 0 ]) square([ length - bend - sheet, sheet ]);
      translate([ 0, bend + sheet ]) square([ sheet, height - bend - sheet ]);
      intersection()
      {
        translate([ bend + sheet, bend + sheet ]) circle(bend + sheet, $fn = 32);
        square(bend + sheet);
      }
    }
    translate([ bend + sheet, bend + sheet ]) circle(bend, $fn = 32);
  }
}

difference()
{
  translate([ 0, width, 0 ]) rotate([ 90, 0, 0 ]) linear_extrude(width) section();
  // Relief beside the flange.
  translate([ -1, -1, -1 ]) cube([ bend + sheet + 3, notch + 1, height + 2 ]);
  // Cut corner of the base.
  translate([ length, width, 0 ]) rotate([ 0, 0, 45 ]) cube([ 22, 22, 20 ], center = true);
  // Holes of the base.
  translate([ 60, 13, -1 ]) cylinder(d = 11, h = sheet + 2, $fn = 40);
  translate([ 45, 33, -1 ]) cylinder(d = 6, h = sheet + 2, $fn = 32);
  hull() for (y = [ 14, 28 ]) translate([ 23, y, -1 ]) cylinder(d = 7, h = sheet + 2, $fn = 32);
  // Hole of the flange.
  translate([ -1, 30, 16 ]) rotate([ 0, 90, 0 ]) cylinder(d = 8, h = sheet + 2, $fn = 32);
}
