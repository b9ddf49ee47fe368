// The product of two signed words by shift-and-add: one partial product per bit of `b`, the one of
// the sign bit subtracted. One register cut, between sums of four and the sum of these.
//
// Cycles: p is valid in the cycle after a and b; one product per cycle. Never drops a bit: p is the
// exact product.
module product #(
    parameter int A = 20,  // bits of a
    parameter int B = 20   // bits of b; the fewer, the smaller
) (
    input  logic                  clock,
    input  logic signed [  A-1:0] a,      // factor
    input  logic signed [  B-1:0] b,      // factor that is taken bit by bit
    output logic signed [A+B-1:0] p       // a·b of the cycle before
);
  localparam int GROUPS = (B + 3) / 4;

  logic signed [A+3:0] groups[GROUPS];  // four partial products each, of weight 16^group

  for (genvar g = 0; g < GROUPS; g++) begin : gen_group
    localparam int BITS = B - 4 * g < 4 ? B - 4 * g : 4;
    logic signed [A+3:0] partial;
    logic signed [A+3:0] sum;
    always_comb begin
      sum = '0;
      partial = '0;
      for (int at = 0; at < BITS; at++) begin
        partial = b[4*g+at] ? (A + 4)'(a) <<< at : '0;
        if (4 * g + at == B - 1) sum = sum - partial;
        else sum = sum + partial;
      end
    end
    always_ff @(posedge clock) groups[g] <= sum;
  end

  always_comb begin
    p = '0;
    for (int g = 0; g < GROUPS; g++) p = p + ((A + B)'(groups[g]) <<< (4 * g));
  end
endmodule
