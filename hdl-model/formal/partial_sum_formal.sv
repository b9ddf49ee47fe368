// The sum of partial products is a b: the recursion's step, and its end.
//
// With b = low + 2^LOW high, low not negative: partial_sum(a, b) = partial_sum(a, low) + 2^LOW
// partial_sum(a, high). Both sides have A + B bits, in which a b fits, and a partial sum's bits are
// sign-extended, so the equation holds between integers once it holds for the halves. Where there are
// no halves (one bit, or two bits with a sign), partial_sum(a, b) = a b directly. The induction is in
// product_formal.sv.
module partial_sum_formal #(
    parameter int A      = 32,
    parameter int B      = 8,
    parameter int SIGNED = 0
) (
    input  logic [A-1:0] a,
    input  logic [B-1:0] b,
    output logic         cover_ends  // both operands at the ends of their ranges
);
  logic [A+B-1:0] sum, expected;
  partial_sum #(.A(A), .B(B), .SIGNED(SIGNED)) dut (.a(a), .b(b), .sum(sum));

  generate
    if (B == 1 || (B == 2 && SIGNED != 0)) begin : gen_end
      // A bit's multiple of a; the sign's weight is negative.
      logic [A+B-1:0] wide, first, second;
      assign wide = {{B{a[A-1]}}, a};
      assign first = b[0] ? wide : '0;
      assign second = B == 2 && b[B-1] ? wide << 1 : '0;
      assign expected = first - second;
    end else begin : gen_step
      localparam int LOW = B / 2;
      localparam int HIGH = B - LOW;
      logic [A+LOW-1:0] low;
      logic [A+HIGH-1:0] high;
      partial_sum #(.A(A), .B(LOW), .SIGNED(0)) lower (.a(a), .b(b[LOW-1:0]), .sum(low));
      partial_sum #(.A(A), .B(HIGH), .SIGNED(SIGNED)) upper (.a(a), .b(b[B-1:LOW]), .sum(high));
      assign expected = {{HIGH{low[A+LOW-1]}}, low} + {high, {LOW{1'b0}}};
    end
  endgenerate
  always_comb assert (sum == expected);

  assign cover_ends = a == {1'b1, {(A - 1) {1'b0}}} && (&b) && sum != '0;
endmodule
