# E4: the three steps of Halley's in cube_root (engine/numeric/elementary.h), from a guess within 5 % of C, the cube root of
# x, on: t1 is within 1e-4 of it, t2 within 6.8e-13, and t3, the result, within 2 u, roundings included. How the guess is
# found is by hand. Of 8 x it is twice the same, so that guesses from 1 to 2 are all of them.
@rnd = float<ieee_64, ne>;

x = C * C * C;

cube0 rnd = (t0 * t0) * t0;
short0 rnd = x - cube0;
whole0 rnd = (cube0 + cube0) + x;
part0 rnd = short0 / whole0;
t1 rnd = t0 + t0 * part0;

cube1 rnd = (t1 * t1) * t1;
short1 rnd = x - cube1;
whole1 rnd = (cube1 + cube1) + x;
part1 rnd = short1 / whole1;
t2 rnd = t1 + t1 * part1;

cube2 rnd = (t2 * t2) * t2;
short2 rnd = x - cube2;
whole2 rnd = (cube2 + cube2) + x;
part2 rnd = short2 / whole2;
t3 rnd = t2 + t2 * part2;

# The same steps, each from a rounded place but without rounding of its own.
T0 = t0 * t0 * t0;
Short0 = x - T0;
Whole0 = (T0 + T0) + x;
Step0 = t0 + t0 * (Short0 / Whole0);
off0 = (t0 - C) / C;
T1 = t1 * t1 * t1;
Short1 = x - T1;
Whole1 = (T1 + T1) + x;
Step1 = t1 + t1 * (Short1 / Whole1);
off1 = (t1 - C) / C;
T2 = t2 * t2 * t2;
Short2 = x - T2;
Whole2 = (T2 + T2) + x;
Step2 = t2 + t2 * (Short2 / Whole2);
off2 = (t2 - C) / C;

{ @FLT(t0, 53) /\ t0 in [1, 2] /\ |t0 -/ C| <= 0.05 ->
  |t1 -/ C| <= 1e-4 /\ |t2 -/ C| <= 6.8e-13 /\ |t3 -/ C| <= 1b-52 }

# What Gappa does not see by itself: x and t^3 are nearly one, so that rounding t^3 makes a third of its part of x in the
# quotient; and a step without rounding cubes the error. These are identities, and it says so of any
# that is none.
C -> t0 / (1 + off0) { 1 + off0 <> 0, C <> 0 };
short0 / whole0 - Short0 / Whole0 ->
  (short0 - Short0) / whole0 - (Short0 / Whole0) * ((whole0 - Whole0) / whole0)
  { whole0 <> 0, Whole0 <> 0 };
(Step0 - C) / C -> off0 * off0 * off0 * (2 + off0) / (2 * (1 + off0) * (1 + off0) * (1 + off0) + 1)
  { C <> 0, Whole0 <> 0 };
Short0 -> C * C * C * (1 - (1 + off0) * (1 + off0) * (1 + off0)) { C <> 0 };
Whole0 -> C * C * C * (1 + 2 * (1 + off0) * (1 + off0) * (1 + off0)) { C <> 0 };
short1 / whole1 - Short1 / Whole1 ->
  (short1 - Short1) / whole1 - (Short1 / Whole1) * ((whole1 - Whole1) / whole1)
  { whole1 <> 0, Whole1 <> 0 };
(Step1 - C) / C -> off1 * off1 * off1 * (2 + off1) / (2 * (1 + off1) * (1 + off1) * (1 + off1) + 1)
  { C <> 0, Whole1 <> 0 };
Short1 -> C * C * C * (1 - (1 + off1) * (1 + off1) * (1 + off1)) { C <> 0 };
Whole1 -> C * C * C * (1 + 2 * (1 + off1) * (1 + off1) * (1 + off1)) { C <> 0 };
short2 / whole2 - Short2 / Whole2 ->
  (short2 - Short2) / whole2 - (Short2 / Whole2) * ((whole2 - Whole2) / whole2)
  { whole2 <> 0, Whole2 <> 0 };
(Step2 - C) / C -> off2 * off2 * off2 * (2 + off2) / (2 * (1 + off2) * (1 + off2) * (1 + off2) + 1)
  { C <> 0, Whole2 <> 0 };
Short2 -> C * C * C * (1 - (1 + off2) * (1 + off2) * (1 + off2)) { C <> 0 };
Whole2 -> C * C * C * (1 + 2 * (1 + off2) * (1 + off2) * (1 + off2)) { C <> 0 };
