// One step of a non-restoring division: a quotient bit (equation 10).
//
// For a denominator d > 0 and a remainder r with -d <= r < d, the next remainder 2r + b -+ d lies
// there again. Adders only.
module divider_stage #(
    parameter int W = 32  // bits of the denominator
) (
    input  logic signed [  W:0] remainder,      // r
    input  logic signed [W-1:0] denominator,    // d
    input  logic                numerator_bit,  // b, the numerator's next bit
    output logic signed [  W:0] next,           // the next remainder
    output logic                quotient_bit    // one where that is not negative
);
  logic signed [W:0] shifted, divisor;

  assign shifted = {remainder[W-1:0], numerator_bit};
  assign divisor = {denominator[W-1], denominator};
  assign next = remainder[W] ? shifted + divisor : shifted - divisor;
  assign quotient_bit = !next[W];
endmodule
