# E2: support points of a ball, (R / |d|) d, of a disc, and of an ellipsoid, D D d / |D d|, coordinate by coordinate, each
# relative to itself: 4.7 u, 4.1 u and 7.6 u. Lengths are between 2^-100 and 2^100, for no underflow.
@rnd = float<ieee_64, ne>;

n rnd = sqrt((x * x + y * y) + z * z);
ball rnd = (radius / n) * x;
N = sqrt((x * x + y * y) + z * z);

rim rnd = sqrt(x * x + y * y);
disc rnd = (radius / rim) * x;
Rim = sqrt(x * x + y * y);

gx rnd = a * x;
gy rnd = b * y;
gz rnd = c * z;
m rnd = sqrt((gx * gx + gy * gy) + gz * gz);
unit rnd = (1 / m) * gx;
ellipsoid rnd = a * unit;
M = sqrt(((a * x) * (a * x) + (b * y) * (b * y)) + (c * z) * (c * z));

{ @FLT(x, 53) /\ @FLT(y, 53) /\ @FLT(z, 53) /\ @FLT(radius, 53) /\ @FLT(a, 53) /\ @FLT(b, 53) /\ @FLT(c, 53) /\
  |x| in [1b-100, 2] /\ |y| in [1b-100, 2] /\ |z| in [1b-100, 2] /\ radius in [1b-100, 1b100] /\
  a in [1b-100, 1b100] /\ b in [1b-100, 1b100] /\ c in [1b-100, 1b100] ->
  |ball -/ (radius / N * x)| <= 5.2180e-16 /\ |disc -/ (radius / Rim * x)| <= 4.5519e-16 /\
  |ellipsoid -/ (a * (1 / M * (a * x)))| <= 8.4376e-16 }
