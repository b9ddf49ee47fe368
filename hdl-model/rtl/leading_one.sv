// Place of the leading one of a word, counted from its last bit; -1 for zero.
module leading_one #(
    parameter int W = 32  // bits of the word
) (
    input  logic        [W-1:0] word,
    output logic signed [  7:0] place
);
  always_comb begin
    place = -8'sd1;
    for (int b = 0; b < W; b++) begin
      if (word[b]) place = 8'(b);
    end
  end
endmodule
