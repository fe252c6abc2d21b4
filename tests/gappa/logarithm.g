# E12: the series of log m in minus_log_of_complement (engine/numeric/elementary.h), against the same polynomial of the
# exact quotient: 2 u for the quotient and for the series, 0.1 u for its product with y. Truncation and the last sums
# are by hand.
@rnd = float<ieee_64, ne>;

d rnd = f + 2;           # m + 1, with f = m - 1 exact
q rnd = f / d;
y rnd = q * q;
p1 rnd = 0x1.af286bca1af28p-5 + y * 0x1.8618618618618p-5;
p2 rnd = 0x1.e1e1e1e1e1e1ep-5 + y * p1;
p3 rnd = 0x1.1111111111111p-4 + y * p2;
p4 rnd = 0x1.3b13b13b13b14p-4 + y * p3;
p5 rnd = 0x1.745d1745d1746p-4 + y * p4;
p6 rnd = 0x1.c71c71c71c71cp-4 + y * p5;
p7 rnd = 0x1.2492492492492p-3 + y * p6;
p8 rnd = 0x1.999999999999ap-3 + y * p7;
p rnd = 0x1.5555555555555p-2 + y * p8;

Q = f / (f + 2);
Y = Q * Q;
P1 = 0x1.af286bca1af28p-5 + Y * 0x1.8618618618618p-5;
P2 = 0x1.e1e1e1e1e1e1ep-5 + Y * P1;
P3 = 0x1.1111111111111p-4 + Y * P2;
P4 = 0x1.3b13b13b13b14p-4 + Y * P3;
P5 = 0x1.745d1745d1746p-4 + Y * P4;
P6 = 0x1.c71c71c71c71cp-4 + Y * P5;
P7 = 0x1.2492492492492p-3 + Y * P6;
P8 = 0x1.999999999999ap-3 + Y * P7;
P = 0x1.5555555555555p-2 + Y * P8;

{ @FLT(f, 53) /\ f in [1b-53, 0.41422] ->
  |q -/ Q| <= 2.2315e-16 /\ |p -/ P| <= 1b-52 /\ |rnd(y * p) - Y * P| <= 1.1102e-17 }
