// The shift-and-add multiplier: a product is made of its halves.
//
// To show: result = a b of the cycle before, for all a and b. A multiplier as a whole is too hard for
// a solver, its recursion is not. With b = low + 2^LOW high, low not negative, here
//
//   result of product(a, b) = partial_sum(a, low) + 2^LOW partial_sum(a, high)
//
// of the operands of the cycle before, exactly, as partial_sum_formal.sv shows it for partial_sum
// itself down to one bit, where partial_sum(a, b) = a b is shown directly. By induction from there
// partial_sum(a, b) = a b, hence result = a (low + 2^LOW high) = a b. The test runs this for all
// shapes that the machine has, at every level of the recursion.
//
// Identical parts of both sides (the partial sums) become one in optimisation, so that the solver sees
// a single adder.
module product_formal #(
    parameter int A      = 32,
    parameter int B      = 22,
    parameter int SIGNED = 1
) (
    input  logic         clock,
    input  logic [A-1:0] a,
    input  logic [B-1:0] b,
    output logic         cover_ends  // both operands at the ends of their ranges
);
  localparam int LOW = B / 2;
  localparam int HIGH = B - LOW;
  logic [A+B-1:0] result;
  product #(.A(A), .B(B), .SIGNED(SIGNED)) dut (.clock(clock), .a(a), .b(b), .result(result));

  logic [A+LOW-1:0] low;
  logic [A+HIGH-1:0] high;
  partial_sum #(.A(A), .B(LOW), .SIGNED(0)) lower (.a(a), .b(b[LOW-1:0]), .sum(low));
  partial_sum #(.A(A), .B(HIGH), .SIGNED(SIGNED)) upper (.a(a), .b(b[B-1:LOW]), .sum(high));

  // The operands were free in the cycle before, whatever came earlier.
  logic [A+LOW-1:0] low_before;
  logic [A+HIGH-1:0] high_before;
  logic [A-1:0] a_before;
  logic [B-1:0] b_before;
  logic started;
  initial started = 1'b0;
  always_ff @(posedge clock) begin
    started <= 1'b1;
    low_before <= low;
    high_before <= high;
    a_before <= a;
    b_before <= b;
  end

  logic [A+B-1:0] wide_low, wide_high;
  assign wide_low = {{HIGH{low_before[A+LOW-1]}}, low_before};
  assign wide_high = {high_before, {LOW{1'b0}}};
  always_comb begin
    if (started) assert (result == wide_low + wide_high);
  end

  assign cover_ends = started && a_before == {1'b1, {(A - 1) {1'b0}}} && (&b_before)
      && wide_low != '0;
endmodule
