// A 90 degree pipe elbow with a collar at each mouth. A half turn about the line that halves the bend
// swaps the mouths. Origin: the middle of one mouth, the pipe leaves along z and bends towards x.
straight = 12;  // from a mouth to the bend
bend = 20;      // radius of the pipe's middle line
around = 32;
steps = 9;      // of the bend

// [place along the middle line, radius] of the outside, from a mouth to the bend.
outside = [[ 0, 12 ], [ 1, 13 ], [ 9, 13 ], [ 9, 9.5 ]];
inside = [[ 0, 6.5 ]];

function turned(angle) = [ cos(angle), 0, sin(angle) ];
centre = [ bend, 0, straight ];

// A ring of points about the middle line: at the first mouth, in the bend, at the second mouth.
function ring(middle, across, radius) =
  [for (i = [0:around - 1]) let (a = 360 * i / around) middle + radius * (cos(a) * across + sin(a) * [ 0, 1, 0 ])];
function first(p) = ring([ 0, 0, p[0] ], [ -1, 0, 0 ], p[1]);
function bent(k, radius) = let (across = turned(180 - 90 * k / steps)) ring(centre + bend * across, across, radius);
function second(p) = ring([ bend + straight - p[0], 0, bend + straight ], [ 0, 0, 1 ], p[1]);
function reversed(list) = [for (i = [len(list) - 1:-1:0]) list[i]];
function path(profile, radius) = concat(
  [for (p = profile) first(p)], [for (k = [0:steps]) bent(k, radius)], [for (p = reversed(profile)) second(p)]);

// Along the outside there, along the inside back: the rings close in both directions.
rings = concat(path(outside, 9.5), reversed(path(inside, 6.5)));
function index(r, i) = (r % len(rings)) * around + i % around;

polyhedron(
  [for (r = rings) for (p = r) p],
  [for (r = [0:len(rings) - 1]) for (i = [0:around - 1]) for (t = [
    [ index(r, i), index(r + 1, i + 1), index(r + 1, i) ],
    [ index(r, i), index(r, i + 1), index(r + 1, i + 1) ]
  ]) t]);
