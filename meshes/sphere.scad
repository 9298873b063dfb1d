// A ball: the faces of an icosahedron, each divided into a grid, pressed out onto the sphere; their hull.
// Origin: the middle.
radius = 13;
divisions = 9;  // of an icosahedron's edge

golden = (1 + sqrt(5)) / 2;
corners = [for (a = [-1, 1], b = [-golden, golden]) each [[ 0, a, b ], [ a, b, 0 ], [ b, 0, a ]]];
neighbours = function(a, b) norm(corners[a] - corners[b]) < 2.1;  // the edge is 2 long
faces = [for (a = [0:11], b = [a + 1:1:11], c = [b + 1:1:11])
  if (neighbours(a, b) && neighbours(b, c) && neighbours(a, c)) [ corners[a], corners[b], corners[c] ]];

points = [for (f = faces, i = [0:divisions], j = [0:divisions - i])
  let (p = i * f[0] + j * f[1] + (divisions - i - j) * f[2]) radius / norm(p) * p];
hull() polyhedron(points, [for (i = [0:3:len(points) - 3]) [ i, i + 1, i + 2 ]]);
