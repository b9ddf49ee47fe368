// One step of the divider is one step of a long division, at full width (equation 10).
//
// A non-restoring remainder r in [-d, d) stands for the remainder R = r, or r + d where r is negative,
// of a long division: 0 <= R < d. For every d > 0 and every such r the step gives a remainder in
// [-d, d) again, and 2 R + b = q d + R' with the quotient bit q and R' of the next remainder.
//
// So the whole quotient is the floor, by induction over the bits: if the numerator's bits up to here
// are N = Q d + R, then with the next bit they are 2 N + b = (2 Q) d + 2 R + b = (2 Q + q) d + R', and
// 0 <= R' < d makes 2 Q + q the floor of (2 N + b) / d. It starts with N = R = r in [0, d), the
// numerator's high bits, Q = 0.
module divider_stage_formal #(
    parameter int W = 32  // bits of the denominator
) (
    input  logic signed [  W:0] remainder,
    input  logic signed [W-1:0] denominator,
    input  logic                numerator_bit,
    output logic                cover_one,      // cases that must be possible
    output logic                cover_minus_d   // the remainder is the least
);
  logic signed [W:0] next;
  logic quotient_bit;
  divider_stage #(
      .W(W)
  ) stage (
      .remainder(remainder),
      .denominator(denominator),
      .numerator_bit(numerator_bit),
      .next(next),
      .quotient_bit(quotient_bit)
  );

  // Wide enough for every sum here.
  logic signed [W+2:0] r, d, b, n, long, next_long;
  assign r = (W + 3)'(remainder);
  assign d = (W + 3)'(denominator);
  assign n = (W + 3)'(next);
  assign b = $signed({{(W + 2) {1'b0}}, numerator_bit});
  assign long = r < 0 ? r + d : r;
  assign next_long = n < 0 ? n + d : n;

  always_comb begin
    assume (d > 0);
    assume (-d <= r && r < d);
    assert (-d <= n && n < d);
    assert (0 <= next_long && next_long < d);
    assert (long + long + b == (quotient_bit ? d + next_long : next_long));
  end

  assign cover_one = quotient_bit && d[W-2];
  assign cover_minus_d = r == -d && d[W-2];
endmodule
