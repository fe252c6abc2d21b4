# E3: Horner's schemes of sincospi (engine/numeric/elementary.h), against the same polynomials without rounding.
# 2 u each. Constants and truncation are by hand: 0.43 u of pi and 0.6 u of the series for the sine, less for the
# cosine.
@rnd = float<ieee_64, ne>;

y rnd = r * r;
s1 rnd = 0x1.e8f434d018d63p-12 + y * -0x1.6fadb9f155744p-16;
s2 rnd = -0x1.e3074fde8871fp-8 + y * s1;
s3 rnd = 0x1.50783487ee782p-4 + y * s2;
s4 rnd = -0x1.32d2cce62bd86p-1 + y * s3;
s5 rnd = 0x1.466bc6775aae2p+1 + y * s4;
s6 rnd = -0x1.4abbce625be53p+2 + y * s5;
s7 rnd = 0x1.921fb54442d18p+1 + y * s6;
s rnd = r * s7;

Y = r * r;
S1 = 0x1.e8f434d018d63p-12 + Y * -0x1.6fadb9f155744p-16;
S2 = -0x1.e3074fde8871fp-8 + Y * S1;
S3 = 0x1.50783487ee782p-4 + Y * S2;
S4 = -0x1.32d2cce62bd86p-1 + Y * S3;
S5 = 0x1.466bc6775aae2p+1 + Y * S4;
S6 = -0x1.4abbce625be53p+2 + Y * S5;
S7 = 0x1.921fb54442d18p+1 + Y * S6;
S = r * S7;

c1 rnd = -0x1.b6e24f44b128fp-14 + y * 0x1.20c62c2f2d7f5p-18;
c2 rnd = 0x1.f9d38a3763cc3p-10 + y * c1;
c3 rnd = -0x1.a6d1f2a204a8cp-6 + y * c2;
c4 rnd = 0x1.e1f506891babbp-3 + y * c3;
c5 rnd = -0x1.55d3c7e3cbffap+0 + y * c4;
c6 rnd = 0x1.03c1f081b5ac4p+2 + y * c5;
c7 rnd = -0x1.3bd3cc9be45dep+2 + y * c6;
c rnd = 1 + y * c7;

C1 = -0x1.b6e24f44b128fp-14 + Y * 0x1.20c62c2f2d7f5p-18;
C2 = 0x1.f9d38a3763cc3p-10 + Y * C1;
C3 = -0x1.a6d1f2a204a8cp-6 + Y * C2;
C4 = 0x1.e1f506891babbp-3 + Y * C3;
C5 = -0x1.55d3c7e3cbffap+0 + Y * C4;
C6 = 0x1.03c1f081b5ac4p+2 + Y * C5;
C7 = -0x1.3bd3cc9be45dep+2 + Y * C6;
C = 1 + Y * C7;

{ @FLT(r, 53) /\ |r| in [1b-200, 0.25] ->
  |s -/ S| <= 1b-52 /\ |c -/ C| <= 1b-52 }
