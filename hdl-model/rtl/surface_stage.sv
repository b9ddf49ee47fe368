// The interpolator's place in the chain: hands the place of each hit to the interpolation and what
// comes back to the shader. One item per R cycles; an item taken in cycle t can go on in cycle
// t + R - 1 + max(M, KERNEL_LATENCY) + LERP_LATENCY + SLOPE_LATENCY.
//
// Pixels without a hit go the same way; nobody looks at their surface.
module surface_stage #(
    parameter int WIDE = 0,         // words of 64 bits, not 32
    parameter int OUTSTANDING = 8,  // largest memory latency
    localparam int W = WIDE == 1 ? terraline_pkg::WIDE_WIDTH : terraline_pkg::NARROW_WIDTH
) (
    input  logic                clock,
    input  logic                reset,           // forgets all items
    // Coefficients
    input  logic        [  6:0] memory_latency,  // M
    // Items from the stepper
    input  logic                in_valid,        // an item is there
    output logic                in_ready,        // it is taken at this edge
    input  logic        [  1:0] in_hit,          // 0 sky, 1 surface, 2 side, 3 out of range
    input  logic signed [W-1:0] in_ground_x,     // place, x in cells
    input  logic signed [W-1:0] in_ground_z,     // z
    // Requests to the interpolation, and its answers
    output logic                request_valid,   // a place is there
    output logic                request_first,   // in its first cycle
    input  logic                request_last,    // in its last cycle
    output logic signed [W-1:0] request_x,       // place, x
    output logic signed [W-1:0] request_z,       // z
    output logic        [  1:0] request_tag,     // the outcome goes along
    input  logic                answer_valid,    // an answer is there
    input  logic signed [W-1:0] answer_surface,  // surface height
    input  logic signed [W-1:0] answer_slope_x,  // slope against x, negated
    input  logic signed [W-1:0] answer_slope_z,  // against z
    input  logic        [  1:0] answer_tag,      // the outcome
    // Items to the shader
    output logic                out_valid,       // an item is there
    input  logic                out_ready,       // it is taken at this edge
    output logic        [  1:0] out_hit,         // outcome
    output logic signed [W-1:0] out_surface,     // surface height
    output logic signed [W-1:0] out_slope_x,     // slope against x, negated
    output logic signed [W-1:0] out_slope_z      // against z
);
  localparam int STAGES = terraline_pkg::LERP_LATENCY + terraline_pkg::SLOPE_LATENCY;
  localparam int ITEM = 2 + 3 * W;

  // From the coefficient alone, in a register.
  localparam logic [6:0] KERNEL = 7'(terraline_pkg::KERNEL_LATENCY);
  logic [6:0] depth;
  always_ff @(posedge clock) begin
    depth <= (memory_latency < KERNEL ? KERNEL : memory_latency) + 7'(STAGES + 1);
  end

  logic room, busy, take;
  logic [1:0] held_hit;
  logic signed [W-1:0] held_x, held_z;

  assign in_ready = room && !busy;
  assign take = in_valid && in_ready;
  assign request_valid = take || busy;
  assign request_first = take;
  assign request_x = busy ? held_x : in_ground_x;
  assign request_z = busy ? held_z : in_ground_z;
  assign request_tag = busy ? held_hit : in_hit;

  always_ff @(posedge clock) begin
    if (reset) busy <= 1'b0;
    else busy <= request_valid && !request_last;
    if (take) begin
      held_hit <= in_hit;
      held_x <= in_ground_x;
      held_z <= in_ground_z;
    end
  end

  credit #(
      .COUNT(7)
  ) credits (
      .clock(clock),
      .reset(reset),
      .depth(depth),
      .enter(take),
      .leave(out_valid && out_ready),
      .room(room)
  );

  // The answer stands in registers already: it passes by an empty queue.
  logic waiting;
  logic [ITEM-1:0] answer, oldest;

  assign answer = {answer_tag, answer_surface, answer_slope_x, answer_slope_z};
  assign out_valid = waiting || answer_valid;
  assign {out_hit, out_surface, out_slope_x, out_slope_z} = waiting ? oldest : answer;
  queue #(
      .WIDTH(ITEM),
      .DEPTH(OUTSTANDING + STAGES + 1)
  ) results (
      .clock(clock),
      .reset(reset),
      .put(answer_valid && (waiting || !out_ready)),
      .in_item(answer),
      .out_valid(waiting),
      .out_ready(out_ready),
      .out_item(oldest)
  );
endmodule
