// A step of the ray covers at most 2^-k cells per axis, and its largest component more than half of
// that (equation 20), for every view vector and fineness k.
//
// `right` is computed as the stepper does it; stepper_formal.sv shows the same bound for the steps in
// the stepper's registers.
module ray_step_formal #(
    parameter int W     = 32,  // bits of a word
    parameter int POINT = 20   // bits after the point
) (
    input  logic signed [W-1:0] view_x,
    input  logic signed [W-1:0] view_y,
    input  logic signed [W-1:0] view_z,
    input  logic        [  2:0] fineness,      // k
    output logic                cover_right,   // the view vector is shifted to the right and rounded
    output logic                cover_left,    // it is shifted to the left
    output logic                cover_longest  // a step of 2^-k, rounded up
);
  logic [W-1:0] magnitude_x, magnitude_y, magnitude_z;
  logic signed [7:0] leading, right;
  logic signed [W-1:0] step_x, step_y, step_z;
  logic [2:0] forward, backward;

  assign magnitude_x = view_x < 0 ? -view_x : view_x;
  assign magnitude_y = view_y < 0 ? -view_y : view_y;
  assign magnitude_z = view_z < 0 ? -view_z : view_z;
  leading_one #(
      .W(W)
  ) leading_view (
      .word(magnitude_x | magnitude_y | magnitude_z),
      .place(leading)
  );
  assign right = leading + $signed({5'b0, fineness}) - 8'(POINT);
  ray_step #(.W(W), .POINT(POINT)) ray_step_x (.view(view_x), .right(right), .step(step_x), .forward(forward[0]), .backward(backward[0]));
  ray_step #(.W(W), .POINT(POINT)) ray_step_y (.view(view_y), .right(right), .step(step_y), .forward(forward[1]), .backward(backward[1]));
  ray_step #(.W(W), .POINT(POINT)) ray_step_z (.view(view_z), .right(right), .step(step_z), .forward(forward[2]), .backward(backward[2]));

  logic signed [W-1:0] most, half;
  assign most = W'(1) << (8'(POINT) - {5'b0, fineness});
  assign half = most >> 1;
  always_comb begin
    assume (fineness <= 3'd6);
    assert (-most <= step_x && step_x <= most);
    assert (-most <= step_y && step_y <= most);
    assert (-most <= step_z && step_z <= most);
    assert (forward == {step_z >= 0, step_y >= 0, step_x >= 0});
    assert (backward == {step_z <= 0, step_y <= 0, step_x <= 0});
    if (leading >= 0) begin
      assert (step_x >= half || step_x <= -half || step_y >= half || step_y <= -half
          || step_z >= half || step_z <= -half);
    end
  end

  assign cover_right = right > 0 && step_x == half && view_y[0];
  assign cover_left = right < -8'sd1 && step_x != '0;
  assign cover_longest = step_x == most && fineness == 3'd3;
endmodule
