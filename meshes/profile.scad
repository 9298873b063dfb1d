// A rail cut from an extruded section with a T-slot on top and a groove below: its faces slide along x.
// A half turn about z leaves it as it was. Origin: the middle of the bottom.
length = 88;
width = 32;
height = 20;

// The section, seen along x: y to the right, z up.
module section()
{
  difference()
  {
    translate([ -width / 2, 0 ]) offset(1.5, $fn = 24) offset(-1.5) square([ width, height ]);
    translate([ -4.5, 8 ]) square([ 9, height ]);      // mouth of the slot
    translate([ -9.5, 8 ]) square([ 19, 6.5 ]);        // its wide part
    translate([ -5, -1 ]) square([ 10, 4 ]);           // groove
  }
}

translate([ -length / 2, 0, 0 ]) rotate([ 90, 0, 90 ]) linear_extrude(length) section();
