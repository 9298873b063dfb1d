// A spur gear with involute teeth, a bore and a recessed web on both sides. A turn by one tooth and the
// turn end for end leave it as it was. Origin: the middle of the bore; the axis is z.
teeth = 16;
module_mm = 2.5;
pressure = 20;
face = 13;
bore = 12;

pitch = teeth * module_mm / 2;
base = pitch * cos(pressure);
tip = pitch + module_mm;
root = pitch - 1.25 * module_mm;

// Angle between the start of an involute on the base circle and its point at a radius.
function swept(radius) = let (a = acos(base / radius)) tan(a) * 180 / PI - a;
// Half the angle of a tooth at a radius.
function half(radius) = 90 / teeth + swept(pitch) - swept(max(radius, base));
flank = [for (k = [0:4]) let (r = base + (tip - base) * k / 4) [ r, half(r) ]];
tooth = concat([[ root, flank[0][1] ]], flank);

function place(p, middle, side) = p[0] * [ cos(middle + side * p[1]), sin(middle + side * p[1]) ];
outline = [for (t = [0:teeth - 1]) let (m = 360 * t / teeth) each concat(
  [for (p = tooth) place(p, m, -1)], [for (k = [len(tooth) - 1:-1:0]) place(tooth[k], m, 1)])];

difference()
{
  linear_extrude(face, center = true) polygon(outline);
  cylinder(d = bore, h = face + 2, center = true, $fn = 48);
  for (side = [ -1, 1 ]) translate([ 0, 0, side * face / 2 ]) difference()
  {
    cylinder(r = 14.5, h = 6, center = true, $fn = 64);
    cylinder(r = 9.5, h = 8, center = true, $fn = 48);
  }
}
