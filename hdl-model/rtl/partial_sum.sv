// The sum of a multiplier's partial products: a·b as a tree of adders, without a register.
//
// b is split in two; its lower half is never negative. What the lower half gives below the upper
// half's first bit goes straight to the result, so every adder is as wide as its operands. Uses no
// more adders than b has bits.
module partial_sum #(
    parameter int A      = 32,  // bits of a
    parameter int B      = 8,   // bits of b; at least 2 where b is signed
    parameter int SIGNED = 0    // 1: b is signed, 0: b is not negative
) (
    input  logic [  A-1:0] a,   // multiplicand, signed
    input  logic [  B-1:0] b,   // multiplier
    output logic [A+B-1:0] sum  // a·b, signed
);
  generate
    if (B == 1) begin : gen_bit
      assign sum = {a[A-1], a} & {(A + 1) {b[0]}};
    end else if (B == 2 && SIGNED != 0) begin : gen_sign
      // The sign's weight is negative.
      logic signed [A+1:0] one, two;
      assign one = $signed({{2{a[A-1]}}, a} & {(A + 2) {b[0]}});
      assign two = $signed({a[A-1], a, 1'b0} & {(A + 2) {b[1]}});
      assign sum = one - two;
    end else begin : gen_halves
      localparam int LOW = B / 2;
      localparam int HIGH = B - LOW;
      logic [ A+LOW-1:0] low;
      logic [A+HIGH-1:0] high;
      partial_sum #(.A(A), .B(LOW), .SIGNED(0)) lower (.a(a), .b(b[LOW-1:0]), .sum(low));
      partial_sum #(.A(A), .B(HIGH), .SIGNED(SIGNED)) upper (.a(a), .b(b[B-1:LOW]), .sum(high));
      assign sum = {high + {{HIGH{low[A+LOW-1]}}, low[A+LOW-1:LOW]}, low[LOW-1:0]};
    end
  endgenerate
endmodule
