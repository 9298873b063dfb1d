// A turned shaft with shoulders, a collar and a groove: every turn about z leaves it as it was, the
// turn end for end does not. Origin: the middle of the lower end.
rotate_extrude($fn = 48) polygon([
  [ 0, 0 ], [ 5, 0 ], [ 6, 1 ], [ 6, 15 ], [ 9, 15 ], [ 9, 38 ], [ 14, 38 ], [ 15, 39 ], [ 15, 45 ], [ 14, 46 ],
  [ 10, 46 ], [ 10, 72 ], [ 7.5, 72 ], [ 7.5, 84 ], [ 6.5, 84 ], [ 6.5, 86 ], [ 7.5, 86 ], [ 7.5, 91 ], [ 6.5, 92 ],
  [ 0, 92 ]
]);
