// A shift-and-add multiplier: a·b, exact, one cycle after its operands.
//
// Partial products of each quarter of b are summed and kept in registers; the cycle after joins them.
// So there are three adders in a row on both sides of the registers, up to 32 bits of b. Never drops a
// partial product. Takes operands every cycle.
module product #(
    parameter int A      = 32,  // bits of a
    parameter int B      = 22,  // bits of b, at least 5
    parameter int SIGNED = 1    // 1: b is signed, 0: b is not negative
) (
    input  logic           clock,
    input  logic [  A-1:0] a,      // multiplicand, signed
    input  logic [  B-1:0] b,      // multiplier
    output logic [A+B-1:0] result  // a·b of the cycle before, signed
);
  localparam int B0 = B / 4, B1 = B / 2 - B0, B2 = (B - B / 2) / 2, B3 = B - B / 2 - B2;
  logic signed [A+B0-1:0] sum_0, part_0;
  logic signed [A+B1-1:0] sum_1, part_1;
  logic signed [A+B2-1:0] sum_2, part_2;
  logic signed [A+B3-1:0] sum_3, part_3;

  // All quarters but the last are factors that are not negative.
  partial_sum #(.A(A), .B(B0), .SIGNED(0)) quarter_0 (
      .a(a), .b(b[B0-1:0]), .sum(sum_0));
  partial_sum #(.A(A), .B(B1), .SIGNED(0)) quarter_1 (
      .a(a), .b(b[B/2-1:B0]), .sum(sum_1));
  partial_sum #(.A(A), .B(B2), .SIGNED(0)) quarter_2 (
      .a(a), .b(b[B/2+B2-1:B/2]), .sum(sum_2));
  partial_sum #(.A(A), .B(B3), .SIGNED(SIGNED)) quarter_3 (
      .a(a), .b(b[B-1:B/2+B2]), .sum(sum_3));

  always_ff @(posedge clock) begin
    part_0 <= sum_0;
    part_1 <= sum_1;
    part_2 <= sum_2;
    part_3 <= sum_3;
  end
  // One expression, so that synthesis may keep carries apart up to one adder at the end.
  assign result = ((A + B)'(part_0) + ((A + B)'(part_1) <<< B0))
      + (((A + B)'(part_2) <<< (B / 2)) + ((A + B)'(part_3) <<< (B / 2 + B2)));
endmodule
