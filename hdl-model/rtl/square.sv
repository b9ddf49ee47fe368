// The square of a signed word by shift-and-add. Two different bits i > j meet once, with double
// weight, so there are half as many partial products as `product` has:
// a² = sum of a_i 2^2i + sum of a_i a_j 2^(i+j+1), those of the sign bit subtracted.
// One register cut, between sums of four rows and the sum of these.
//
// Cycles: p is valid in the cycle after a; one square per cycle. Never drops a bit.
module square #(
    parameter int A = 20  // bits of a
) (
    input  logic                clock,
    input  logic signed [A-1:0] a,  // what is squared
    output logic [2*A-1:0]      p   // a² of the cycle before
);
  localparam int GROUPS = (A + 2) / 4;  // four rows each; the sign bit is not one of them

  logic [A-1:0] bits;  // a of the cycle before
  logic [2*A-1:0] ones;  // bit i at 2i
  logic [2*A-1:0] negative;  // products with the sign bit
  logic [A+2:0] groups[GROUPS];  // of weight 2^(4 group + 1)

  for (genvar g = 0; g < GROUPS; g++) begin : gen_group
    localparam int ROWS = A - 1 - 4 * g < 4 ? A - 1 - 4 * g : 4;
    logic [A+2:0] all, row, sum;
    assign all = {3'b0, a};
    always_comb begin
      sum = '0;
      row = '0;
      for (int at = 0; at < ROWS; at++) begin
        // The bits below this one.
        row = all[4*g+at] ? all & (((A + 3)'(1) << (4 * g + at)) - (A + 3)'(1)) : '0;
        sum = sum + (row << at);
      end
    end
    always_ff @(posedge clock) groups[g] <= sum;
  end

  always_ff @(posedge clock) bits <= a;

  assign negative = bits[A-1] ? {1'b0, bits[A-2:0], {A{1'b0}}} : '0;

  always_comb begin
    ones = '0;
    for (int at = 0; at < A; at++) ones[2*at] = bits[at];
    p = ones - negative;
    for (int g = 0; g < GROUPS; g++) p = p + ((2 * A)'(groups[g]) << (4 * g + 1));
  end
endmodule
