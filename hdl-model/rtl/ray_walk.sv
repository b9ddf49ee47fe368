// The places of a ray's walk: an axis each for x, y and z (equations 19, 21 and 22; thesis 2.1),
// and whether the ray can still meet anything at three of these places.
//
// Never wraps a position (the plan proves their range), never multiplies.
module ray_walk #(
    parameter int W     = 32,  // bits of a word
    parameter int POINT = 20,  // bits after the point
    parameter int CELL  = 12   // bits of a cell's index
) (
    input  logic                   clock,
    // Coefficients
    input  logic signed [   W-1:0] highest,     // the highest node
    input  logic signed [   W-1:0] base,        // base of the block under the map
    input  logic signed [CELL-1:0] east,        // cells in x
    input  logic signed [CELL-1:0] south,       // cells in z
    input  logic                   map_ends,    // the map ends at its edge
    input  logic                   sides,       // the map has sides
    // The ray
    input  logic signed [   W-1:0] origin_x,    // where it begins, x
    input  logic signed [   W-1:0] origin_y,    // height
    input  logic signed [   W-1:0] origin_z,    // z
    input  logic signed [   W-1:0] step_x,      // its step, x
    input  logic signed [   W-1:0] step_y,      // y
    input  logic signed [   W-1:0] step_z,      // z
    input  logic        [     2:0] forward,     // bits x, y, z: the step is not negative
    input  logic        [     2:0] backward,    // bits x, y, z: the step is not positive
    input  logic        [     5:0] jump_log2,   // steps of a jump, as a power of two
    // What the stepper does in this cycle (ray_axis.sv)
    input  logic                   takes,       // takes a ray
    input  logic                   starts,      // starts the walk
    input  logic                   tries,       // asks for the bound of a jump
    input  logic                   waits,       // waits for it
    input  logic                   issues,      // the sample `issue` is read for the last time
    input  logic                   aims,        // begins to halve
    input  logic                   halves,      // halves
    input  logic                   tests,       // `follow` is answered
    input  logic                   hits,        // and it hits
    input  logic                   moves,       // the jump is made, or the answer is no hit
    // Places
    output logic signed [   W-1:0] place_x,     // clear, x
    output logic signed [   W-1:0] place_y,     // y
    output logic signed [   W-1:0] place_z,     // z
    output logic signed [   W-1:0] follow_x,    // answered next, x
    output logic signed [   W-1:0] follow_y,    // y
    output logic signed [   W-1:0] follow_z,    // z
    output logic signed [   W-1:0] issue_x,     // read next, x
    output logic signed [   W-1:0] issue_z,     // z
    output logic signed [   W-1:0] ahead_x,     // at the end of the jump that is tried, x
    output logic signed [   W-1:0] ahead_y,     // y
    output logic signed [   W-1:0] ahead_z,     // z
    output logic signed [   W-1:0] met_x,       // the last hit, x
    output logic signed [   W-1:0] met_y,       // y
    output logic signed [   W-1:0] met_z,       // z
    // Nothing can be met any more
    output logic                   place_over,  // from `place` on
    output logic                   issue_over,  // from `issue` on
    output logic                   ahead_over   // from `ahead` on
);
  logic signed [W-1:0] issue_y;

  ray_axis #(.W(W)) axis_x (
      .clock(clock), .step(step_x), .origin(origin_x), .jump_log2(jump_log2),
      .takes(takes), .starts(starts), .tries(tries), .waits(waits), .issues(issues),
      .aims(aims), .halves(halves), .answered(tests), .hits(hits), .moves(moves),
      .place(place_x), .follow(follow_x), .issue(issue_x), .ahead(ahead_x), .met(met_x));
  ray_axis #(.W(W)) axis_y (
      .clock(clock), .step(step_y), .origin(origin_y), .jump_log2(jump_log2),
      .takes(takes), .starts(starts), .tries(tries), .waits(waits), .issues(issues),
      .aims(aims), .halves(halves), .answered(tests), .hits(hits), .moves(moves),
      .place(place_y), .follow(follow_y), .issue(issue_y), .ahead(ahead_y), .met(met_y));
  ray_axis #(.W(W)) axis_z (
      .clock(clock), .step(step_z), .origin(origin_z), .jump_log2(jump_log2),
      .takes(takes), .starts(starts), .tries(tries), .waits(waits), .issues(issues),
      .aims(aims), .halves(halves), .answered(tests), .hits(hits), .moves(moves),
      .place(place_z), .follow(follow_z), .issue(issue_z), .ahead(ahead_z), .met(met_z));

  ray_end #(.W(W), .CELL(CELL)) end_at_place (
      .highest(highest), .base(base), .east(east), .south(south), .map_ends(map_ends),
      .sides(sides), .i(place_x[POINT+:CELL]), .y(place_y), .j(place_z[POINT+:CELL]),
      .forward(forward), .backward(backward), .over(place_over));
  ray_end #(.W(W), .CELL(CELL)) end_at_issue (
      .highest(highest), .base(base), .east(east), .south(south), .map_ends(map_ends),
      .sides(sides), .i(issue_x[POINT+:CELL]), .y(issue_y), .j(issue_z[POINT+:CELL]),
      .forward(forward), .backward(backward), .over(issue_over));
  ray_end #(.W(W), .CELL(CELL)) end_ahead (
      .highest(highest), .base(base), .east(east), .south(south), .map_ends(map_ends),
      .sides(sides), .i(ahead_x[POINT+:CELL]), .y(ahead_y), .j(ahead_z[POINT+:CELL]),
      .forward(forward), .backward(backward), .over(ahead_over));
endmodule
