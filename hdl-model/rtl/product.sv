// A shift-and-add multiplier: a·b, exact, one cycle after its operands.
//
// Partial products of the lower and of the upper half of b are summed and kept in registers; one
// adder joins them in the cycle after. Never drops a partial product. Takes operands every cycle.
module product #(
    parameter int A      = 32,  // bits of a
    parameter int B      = 22,  // bits of b, at least 3
    parameter int SIGNED = 1    // 1: b is signed, 0: b is not negative
) (
    input  logic           clock,
    input  logic [  A-1:0] a,      // multiplicand, signed
    input  logic [  B-1:0] b,      // multiplier
    output logic [A+B-1:0] result  // a·b of the cycle before, signed
);
  localparam int LOW = B / 2;
  localparam int HIGH = B - LOW;
  logic [ A+LOW-1:0] low_sum, low;
  logic [A+HIGH-1:0] high_sum, high;

  partial_sum #(.A(A), .B(LOW), .SIGNED(0)) lower (.a(a), .b(b[LOW-1:0]), .sum(low_sum));
  partial_sum #(.A(A), .B(HIGH), .SIGNED(SIGNED)) upper (.a(a), .b(b[B-1:LOW]), .sum(high_sum));

  always_ff @(posedge clock) begin
    low  <= low_sum;
    high <= high_sum;
  end
  assign result = {high + {{HIGH{low[A+LOW-1]}}, low[A+LOW-1:LOW]}, low[LOW-1:0]};
endmodule
