// The beginning of a ray: its view vector becomes a step whose largest component covers between
// 2^-k-1 and 2^-k cells (equation 20). Three cycles: the vector is taken, its largest component found,
// the step made.
module ray_setup #(
    parameter int W     = 32,  // bits of a word
    parameter int POINT = 20   // bits after the point
) (
    input  logic                clock,
    // Coefficients
    input  logic        [  2:0] fineness,   // k: steps of at most 2^-k cells
    // What the stepper does in this cycle
    input  logic                takes,      // takes a ray
    input  logic                scales,     // finds its largest component
    input  logic                makes,      // makes its step
    // The ray
    input  logic signed [W-1:0] in_view_x,  // view vector, x
    input  logic signed [W-1:0] in_view_y,  // y
    input  logic signed [W-1:0] in_view_z,  // z
    output logic signed [W-1:0] step_x,     // step, x
    output logic signed [W-1:0] step_y,     // y
    output logic signed [W-1:0] step_z,     // z
    output logic        [  2:0] forward,    // bits x, y, z: the step is not negative
    output logic        [  2:0] backward,   // bits x, y, z: the step is not positive
    // For the proofs about the stepper
    output logic signed [W-1:0] view_x,     // view vector, x
    output logic signed [W-1:0] view_y,     // y
    output logic signed [W-1:0] view_z,     // z
    output logic        [W-1:0] longest,    // has the leading one of the largest component
    output logic signed [  7:0] right       // shift of the view vector to a step
);
  logic [W-1:0] magnitude_x, magnitude_y, magnitude_z;
  logic signed [7:0] leading;
  logic signed [W-1:0] new_step_x, new_step_y, new_step_z;
  logic [2:0] new_forward, new_backward;

  assign magnitude_x = in_view_x < 0 ? -in_view_x : in_view_x;
  assign magnitude_y = in_view_y < 0 ? -in_view_y : in_view_y;
  assign magnitude_z = in_view_z < 0 ? -in_view_z : in_view_z;
  leading_one #(.W(W)) leading_view (.word(longest), .place(leading));
  ray_step #(.W(W), .POINT(POINT)) ray_step_x (
      .view(view_x), .right(right),
      .step(new_step_x), .forward(new_forward[0]), .backward(new_backward[0]));
  ray_step #(.W(W), .POINT(POINT)) ray_step_y (
      .view(view_y), .right(right),
      .step(new_step_y), .forward(new_forward[1]), .backward(new_backward[1]));
  ray_step #(.W(W), .POINT(POINT)) ray_step_z (
      .view(view_z), .right(right),
      .step(new_step_z), .forward(new_forward[2]), .backward(new_backward[2]));

  always_ff @(posedge clock) begin
    if (takes) begin
      view_x <= in_view_x;
      view_y <= in_view_y;
      view_z <= in_view_z;
      longest <= magnitude_x | magnitude_y | magnitude_z;
    end
    if (scales) right <= leading + $signed({5'b0, fineness}) - 8'(POINT);
    if (makes) begin
      step_x <= new_step_x;
      step_y <= new_step_y;
      step_z <= new_step_z;
      forward <= new_forward;
      backward <= new_backward;
    end
  end
endmodule
