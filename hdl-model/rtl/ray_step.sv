// A step of the ray: a component of the view vector divided by 2^(right + 1) and rounded to nearest,
// ties upward (equation 20). A negative `right` multiplies by 2^(-right - 1). A step is at most one
// cell long: no more bits are made than it has.
module ray_step #(
    parameter int W     = 32,  // bits of a word
    parameter int POINT = 20   // bits after the point
) (
    input  logic signed [W-1:0] view,     // component of the view vector
    input  logic signed [  7:0] right,    // shift to the right without its last place, less than W - 1
    output logic signed [W-1:0] step,     // component of the step
    output logic                forward,  // it is not negative
    output logic                backward  // it is not positive
);
  localparam int S = POINT + 3;
  logic signed [S-1:0] to_right, to_left, half, rounded;
  logic is_left;

  // The bit below the last one rounds, so that both 0 and -1 give zero.
  assign is_left = right < 0;
  assign to_right = S'(view >>> right);
  assign to_left = S'(view <<< ~right);
  assign half = to_right >>> 1;
  assign rounded = half + $signed({{(S - 1) {1'b0}}, to_right[0]});
  assign step = is_left ? W'(to_left) : W'(rounded);
  assign forward = view >= 0 || (!is_left && to_right == '1);
  assign backward = view < 0 || (is_left ? view == '0 : to_right == '0);
endmodule
