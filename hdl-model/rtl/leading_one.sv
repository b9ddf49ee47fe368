// Place of the leading one of a word, counted from its last bit; -1 for zero.
module leading_one #(
    parameter int W = 32  // bits of the word
) (
    input  logic        [W-1:0] word,
    output logic signed [  7:0] place
);
  // In halves: if there is a one in the upper half of what is left, the place is there, else below.
  localparam int LEVELS = $clog2(W);
  logic [(1<<LEVELS)-1:0] left, upper;
  logic [7:0] sum;

  always_comb begin
    left = (1 << LEVELS)'(word);
    sum = '0;
    upper = '0;
    for (int level = LEVELS - 1; level >= 0; level--) begin
      upper = left >> (1 << level);
      if (upper != '0) begin
        left = upper;
        sum = sum | (8'd1 << level);
      end
    end
    place = word == '0 ? -8'sd1 : $signed(sum);
  end
endmodule
