// A plain pin with a chamfer at each end: every turn about z and the turn end for end leave it as it was.
// Origin: the middle of the axis.
radius = 8;
length = 58;
chamfer = 1.5;

rotate_extrude($fn = 64) polygon([
  [ 0, -length / 2 ], [ radius - chamfer, -length / 2 ], [ radius, -length / 2 + chamfer ],
  [ radius, length / 2 - chamfer ], [ radius - chamfer, length / 2 ], [ 0, length / 2 ]
]);
