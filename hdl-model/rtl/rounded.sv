// base + sum / 2^POINT, rounded once, to nearest, ties upward. No cycles.
module rounded #(
    parameter int W     = 32,  // bits of a word
    parameter int SUM   = 54,  // bits of the sum of products, at least W + POINT
    parameter int POINT = 20   // fraction bits of the multipliers
) (
    input  logic [SUM-1:0] sum,    // of exact products, signed
    input  logic [  W-1:0] base,   // what is added to it
    output logic [  W-1:0] result  // modulo 2^W
);
  logic [W+POINT-1:0] total;
  // Half of the last bit fills the place below the base.
  assign total  = (W + POINT)'(sum) + {base, 1'b1, {(POINT - 1) {1'b0}}};
  assign result = W'(total >> POINT);
endmodule
