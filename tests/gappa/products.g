# E1, E2, E20, E22: heights along a direction, coordinates of placed vertices, and the turn of two points of a shadow.
# Coordinates and coefficients are at most 1; scaling by powers of two makes that no loss.
@rnd = float<ieee_64, ne>;

height rnd = (x1 * d1 + x2 * d2) + x3 * d3;
placed rnd = ((x1 * d1 + x2 * d2) + x3 * d3) + t;
turn rnd = x1 * d2 - x2 * d1;

{ |x1| <= 1 /\ |x2| <= 1 /\ |x3| <= 1 /\ |d1| <= 1 /\ |d2| <= 1 /\ |d3| <= 1 /\ |t| <= 1 ->
  |height - ((x1 * d1 + x2 * d2) + x3 * d3)| <= 9b-54 /\
  |placed - (((x1 * d1 + x2 * d2) + x3 * d3) + t)| <= 13b-54 /\
  |turn - (x1 * d2 - x2 * d1)| <= 1b-52 }
