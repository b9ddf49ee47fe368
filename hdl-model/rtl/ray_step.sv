// A step of the ray: a component of the view vector divided by 2^places and rounded to nearest, ties
// upward (equation 20). Negative places multiply.
module ray_step #(
    parameter int W = 32  // bits of a word
) (
    input  logic signed [W-1:0] view,    // component of the view vector
    input  logic signed [  7:0] places,  // shift to the right, less than W
    output logic signed [W-1:0] step     // component of the step
);
  logic [7:0] left, right;
  logic signed [W-1:0] shifted, rounding;

  assign left = 8'(-places);
  assign right = 8'(places - 8'sd1);
  // The bit below the last one rounds.
  assign shifted = view >>> right;
  assign rounding = {{(W - 1) {1'b0}}, shifted[0]};
  assign step = places > 0 ? (shifted >>> 1) + rounding : view <<< left;
endmodule
