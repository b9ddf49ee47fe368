// The shift-and-add multiplier: a product is made of its quarters.
//
// To show: result = a b of the cycle before, for all a and b. A multiplier as a whole is too hard for
// a solver, its recursion is not. With b = b0 + 2^s1 b1 + 2^s2 b2 + 2^s3 b3, only b3 ever negative, here
//
//   result of product(a, b) = sum of 2^si partial_sum(a, bi)
//
// of the operands of the cycle before, exactly, as partial_sum_formal.sv shows it for the halves of
// partial_sum itself down to one bit, where partial_sum(a, b) = a b is shown directly. By induction
// from there partial_sum(a, b) = a b, hence result = a b. The test runs this for all shapes that the
// machine has, at every level of the recursion.
//
// Identical parts of both sides (the partial sums, registers and all) become one in optimisation, so
// that the solver is left with three adders on either side.
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
  localparam int B0 = B / 4, B1 = B / 2 - B0, B2 = (B - B / 2) / 2, B3 = B - B / 2 - B2;
  logic [A+B-1:0] result;
  product #(.A(A), .B(B), .SIGNED(SIGNED)) dut (.clock(clock), .a(a), .b(b), .result(result));

  logic [A+B0-1:0] sum_0;
  logic [A+B1-1:0] sum_1;
  logic [A+B2-1:0] sum_2;
  logic [A+B3-1:0] sum_3;
  partial_sum #(.A(A), .B(B0), .SIGNED(0)) quarter_0 (
      .a(a), .b(b[B0-1:0]), .sum(sum_0));
  partial_sum #(.A(A), .B(B1), .SIGNED(0)) quarter_1 (
      .a(a), .b(b[B0+B1-1:B0]), .sum(sum_1));
  partial_sum #(.A(A), .B(B2), .SIGNED(0)) quarter_2 (
      .a(a), .b(b[B0+B1+B2-1:B0+B1]), .sum(sum_2));
  partial_sum #(.A(A), .B(B3), .SIGNED(SIGNED)) quarter_3 (
      .a(a), .b(b[B-1:B0+B1+B2]), .sum(sum_3));

  // Of the cycle before; the operands were free then, whatever came earlier.
  logic [A+B0-1:0] part_0;
  logic [A+B1-1:0] part_1;
  logic [A+B2-1:0] part_2;
  logic [A+B3-1:0] part_3;
  logic [A-1:0] a_before;
  logic [B-1:0] b_before;
  logic started;
  initial started = 1'b0;
  always_ff @(posedge clock) begin
    started <= 1'b1;
    part_0 <= sum_0;
    part_1 <= sum_1;
    part_2 <= sum_2;
    part_3 <= sum_3;
    a_before <= a;
    b_before <= b;
  end

  logic [A+B-1:0] wide_0, wide_1, wide_2, wide_3;
  assign wide_0 = {{(B - B0) {part_0[A+B0-1]}}, part_0};
  assign wide_1 = {{(B - B0 - B1) {part_1[A+B1-1]}}, part_1, {B0{1'b0}}};
  assign wide_2 = {{B3{part_2[A+B2-1]}}, part_2, {(B0 + B1) {1'b0}}};
  assign wide_3 = {part_3, {(B0 + B1 + B2) {1'b0}}};
  always_comb begin
    if (started) assert (result == (wide_0 + wide_1) + (wide_2 + wide_3));
  end

  assign cover_ends = started && a_before == {1'b1, {(A - 1) {1'b0}}} && (&b_before)
      && wide_0 != '0;
endmodule
