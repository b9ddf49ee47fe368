// One step of a non-restoring division: a quotient bit (equation 10).
//
// For a denominator d > 0 and a remainder r with -d <= r < d, the next remainder 2r + b -+ d lies
// there again. One adder: what is subtracted is added with inverted bits, and a carry from below.
module divider_stage #(
    parameter int W = 32  // bits of the denominator
) (
    input  logic signed [  W:0] remainder,      // r
    input  logic signed [W-1:0] denominator,    // d
    input  logic                numerator_bit,  // b, the numerator's next bit
    output logic signed [  W:0] next,           // the next remainder
    output logic                quotient_bit    // one where that is not negative
);
  logic subtract;
  logic [W:0] divisor;
  logic [W+1:0] sum;  // and below it the carry

  assign subtract = !remainder[W];
  assign divisor = {denominator[W-1], denominator} ^ {(W + 1) {subtract}};
  assign sum = {remainder[W-1:0], numerator_bit, 1'b1} + {divisor, subtract};
  assign next = sum[W+1:1];
  assign quotient_bit = !next[W];
endmodule
