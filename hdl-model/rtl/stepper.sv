// The ray stepper: the first sample of a ray under the surface (docs/units/stepper.md).
//
// One ray at a time, as a state machine; its work on a ray takes
// 4 + skip tests (1 + M) + samples R + bursts (N + 5) + bisection steps (R + N + 5) + hits 2 cycles with
// N = max(M, 2), on maps with holes 2 R + N + 5 more per hit (docs/cycles.md). Here is what happens when.
// The step is made by `ray_setup`, places are in `ray_walk`, the count of samples and what follows in
// `walk_plan`; `skip_test` and `sample_burst` ask, `bisection` counts the bisection steps behind a hit, and
// `walk_end` says what comes of it.
//
// Never wraps a position (the plan proves their range), never passes a sample that might hit, never
// multiplies.
module stepper #(
    parameter int WIDE = 0  // words of 64 bits, not 32
) (
    input  logic                                    clock,
    input  logic                                    reset,            // forgets all rays
    // Coefficients
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] eye_x,            // the eye, x in cells
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] eye_y,            // y in height units
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] eye_z,            // z in cells
    input  logic                                    from_eye,         // rays start at the eye
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] highest,          // the highest node
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] base,             // base of the block under the map
    input  logic        [                      2:0] fineness,         // k: steps of at most 2^-k cells
    input  logic        [                     25:0] last,             // index of the last sample
    input  logic                                    bisection_fixed,  // always bisection_cap bisection steps
    input  logic signed [                      7:0] bisection_bias,   // bisection steps at distance one
    input  logic        [                      5:0] bisection_cap,    // most bisection steps
    input  logic                                    skipping,         // the pyramid is fitted
    input  logic        [                      4:0] pyramid_top,      // its highest level
    input  logic                                    beyond_sky,       // out of range is sky
    input  logic        [(WIDE == 1 ? 26 : 12)-1:0] map_columns,      // nodes in x
    input  logic        [(WIDE == 1 ? 26 : 12)-1:0] map_rows,         // nodes in z
    input  logic                                    map_ends,         // the map ends at its edge
    input  logic                                    sides,            // the map has sides
    input  logic                                    void_bits,        // nodes may have no data
    // Items from the divider, or from the projector where rays start at the eye
    input  logic                                    in_valid,         // an item is there
    output logic                                    in_ready,         // it is taken at this edge
    input  logic        [                      1:0] in_entry,         // 0 met, 1 sky, 2 out of range
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] in_view_x,        // view vector, x
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] in_view_y,        // y
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] in_view_z,        // z
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] in_ground_x,      // where the ray enters, x
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] in_ground_z,      // z
    // Memory of the pyramid's bounds
    output logic                                    bound_read,       // an address is there
    output logic        [                      4:0] bound_level,      // level
    output logic        [(WIDE == 1 ? 26 : 12)-1:0] bound_column,     // stored bound, x
    output logic        [(WIDE == 1 ? 26 : 12)-1:0] bound_row,        // z
    input  logic                                    bound_valid,      // M cycles later: the bound is there
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] bound,            // height units
    // Samples to the interpolation, and its answers
    output logic                                    sample_valid,     // a sample is there
    output logic                                    sample_first,     // in its first cycle
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] sample_x,         // place, x
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] sample_z,         // z
    output logic        [                      2:0] sample_tag,       // goes along
    input  logic                                    sample_last,      // in its last cycle
    input  logic                                    answer_valid,     // an answer is there
    input  logic                                    answer_exists,    // there is a surface at the place
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] answer_surface,   // its height
    input  logic        [                      2:0] answer_tag,       // came along
    // Items to the interpolator
    output logic                                    out_valid,        // an item is there
    input  logic                                    out_ready,        // it is taken at this edge
    output logic        [                      1:0] out_hit,          // 0 sky, 1 surface, 2 side, 3 out of range
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] out_ground_x,     // place of the hit, x
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] out_ground_z,     // z
    output logic        [                     25:0] out_steps         // index of the sample that hit
);
  localparam int W = WIDE == 1 ? terraline_pkg::WIDE_WIDTH : terraline_pkg::NARROW_WIDTH;
  localparam int POINT = WIDE == 1 ? terraline_pkg::WIDE_POINT : terraline_pkg::NARROW_POINT;
  localparam int CELL = WIDE == 1 ? 26 : 12;
  localparam int DEPTH = terraline_pkg::STEPPER_DEPTH;

  localparam logic [1:0] ENTRY_MET = 2'd0;

  localparam logic [3:0] IDLE = 4'd0;  // waits for a ray, and takes it
  localparam logic [3:0] SCALE = 4'd1;  // finds its largest component
  localparam logic [3:0] STEP = 4'd2;  // makes its step
  localparam logic [3:0] START = 4'd3;  // starts its walk
  localparam logic [3:0] SKIP = 4'd4;  // asks for a bound
  localparam logic [3:0] BOUND = 4'd5;  // waits for it, and jumps or not
  localparam logic [3:0] SAMPLE = 4'd6;  // a burst of samples streams
  localparam logic [3:0] AIM = 4'd7;  // takes the distance of the hit
  localparam logic [3:0] HALVE = 4'd8;  // asks whether the middle hits
  localparam logic [3:0] RIM = 4'd9;  // asks whether there is a surface beside the hit
  localparam logic [3:0] PLACE = 4'd10;  // places the hit

  logic [3:0] state;

  // What happens in this cycle.
  logic takes, starts, tries, waits, streams, aims, halves, rims;
  assign takes = state == IDLE;
  assign starts = state == START;
  assign tries = state == SKIP;
  assign waits = state == BOUND;
  assign streams = state == SAMPLE;
  assign aims = state == AIM;
  assign halves = state == HALVE;
  assign rims = state == RIM;

  // Cells of the map, of coefficients alone.
  logic signed [CELL-1:0] east, south;
  always_ff @(posedge clock) begin
    east <= $signed(map_columns) - CELL'(1);
    south <= $signed(map_rows) - CELL'(1);
  end

  // ---- The ray and its places.
  logic [1:0] entry;
  logic signed [W-1:0] view_x, view_y, view_z;
  logic [W-1:0] longest;
  logic signed [7:0] right;
  logic signed [W-1:0] step_x, step_y, step_z;
  logic [2:0] forward, backward;
  logic signed [W-1:0] place_x, place_y, place_z;
  logic signed [W-1:0] follow_x, follow_y, follow_z;
  logic signed [W-1:0] issue_x, issue_z;
  logic signed [W-1:0] ahead_x, ahead_y, ahead_z;
  logic signed [W-1:0] met_x, met_y, met_z;
  logic place_over, issue_over, ahead_over;
  logic [5:0] jump_log2;
  logic issues, answered, hits;
  logic clear;
  logic tests, moves;

  always_ff @(posedge clock) if (takes) entry <= from_eye ? ENTRY_MET : in_entry;
  ray_setup #(.W(W), .POINT(POINT)) ray_setup (
      .clock(clock), .fineness(fineness),
      .takes(takes), .scales(state == SCALE), .makes(state == STEP),
      .in_view_x(in_view_x), .in_view_y(in_view_y), .in_view_z(in_view_z),
      .step_x(step_x), .step_y(step_y), .step_z(step_z), .forward(forward), .backward(backward),
      .view_x(view_x), .view_y(view_y), .view_z(view_z), .longest(longest), .right(right));

  assign tests = answered && (streams || halves);
  assign moves = (waits && bound_valid && clear) || (tests && !hits);
  ray_walk #(.W(W), .POINT(POINT), .CELL(CELL)) ray_walk (
      .clock(clock), .highest(highest), .base(base), .east(east), .south(south),
      .map_ends(map_ends), .sides(sides),
      .origin_x(from_eye ? eye_x : in_ground_x), .origin_y(from_eye ? eye_y : highest),
      .origin_z(from_eye ? eye_z : in_ground_z),
      .step_x(step_x), .step_y(step_y), .step_z(step_z), .forward(forward), .backward(backward),
      .jump_log2(jump_log2), .takes(takes), .starts(starts), .tries(tries), .waits(waits),
      .issues(issues), .aims(aims), .halves(halves), .tests(tests), .hits(hits), .moves(moves),
      .place_x(place_x), .place_y(place_y), .place_z(place_z),
      .follow_x(follow_x), .follow_y(follow_y), .follow_z(follow_z),
      .issue_x(issue_x), .issue_z(issue_z),
      .ahead_x(ahead_x), .ahead_y(ahead_y), .ahead_z(ahead_z),
      .met_x(met_x), .met_y(met_y), .met_z(met_z),
      .place_over(place_over), .issue_over(issue_over), .ahead_over(ahead_over));

  // ---- What follows: a skip test or a burst of samples.
  logic [25:0] remaining, remaining_next, remaining_ahead;
  logic signed [7:0] ahead_leading;
  logic [4:0] level;
  logic skip_test_follows;
  logic [6:0] run;
  logic tag_last, tag_over;
  logic [3:0] walk_on;

  walk_plan plan (
      .clock(clock), .fineness(fineness), .last(last), .skipping(skipping),
      .pyramid_top(pyramid_top), .starts(starts), .tries(tries), .waits(waits),
      .bounded(bound_valid), .clear(clear), .passes(streams && answered), .ends_burst(tag_last),
      .remaining(remaining), .remaining_next(remaining_next), .remaining_ahead(remaining_ahead),
      .ahead_leading(ahead_leading), .level(level), .jump_log2(jump_log2),
      .skip_test_follows(skip_test_follows), .run(run));
  assign walk_on = skip_test_follows ? SKIP : SAMPLE;

  // ---- The skip test.
  logic none;

  assign bound_read = tries;
  assign bound_level = level;
  skip_test #(.W(W), .CELL(CELL)) skip_test (
      .clock(clock), .map_columns(map_columns), .map_rows(map_rows), .map_ends(map_ends),
      .tries(tries), .level(level), .i(place_x[POINT+:CELL]), .j(place_z[POINT+:CELL]),
      .place_y(place_y), .ahead_y(ahead_y), .bound_column(bound_column), .bound_row(bound_row),
      .bound(bound), .none(none), .clear(clear));

  // ---- Samples.
  logic ends;  // behind this answer, none is of interest
  logic rim_answered, clear_exists, middle_exists;
  logic [6:0] to_issue;

  sample_burst #(.W(W)) sample_burst (
      .clock(clock), .reset(reset), .plans(starts || waits), .streams(streams),
      .halves(halves), .rims(rims), .ends(ends), .run(run),
      .issue_x(issue_x), .issue_z(issue_z), .issue_over(issue_over),
      .place_x(place_x), .place_z(place_z),
      .follow_x(follow_x), .follow_y(follow_y), .follow_z(follow_z),
      .sample_valid(sample_valid), .sample_first(sample_first), .sample_x(sample_x),
      .sample_z(sample_z), .sample_tag(sample_tag), .sample_last(sample_last),
      .answer_valid(answer_valid), .answer_exists(answer_exists),
      .answer_surface(answer_surface), .answer_tag(answer_tag),
      .issues(issues), .answered(answered), .hits(hits), .tag_last(tag_last),
      .tag_over(tag_over), .rim_answered(rim_answered), .clear_exists(clear_exists),
      .middle_exists(middle_exists), .to_issue(to_issue));

  // ---- The bisection steps behind a hit (equation 22).
  logic bisects;
  logic aimed;  // the first cycle of the bisection
  logic [5:0] times, bisections_left;

  bisection #(.W(W), .POINT(POINT)) bisection (
      .clock(clock), .eye_x(eye_x), .eye_y(eye_y), .eye_z(eye_z),
      .fixed(bisection_fixed), .bias(bisection_bias), .cap(bisection_cap),
      .x(follow_x), .y(follow_y), .z(follow_z), .any(bisects), .times(times));
  always_ff @(posedge clock) begin
    aimed <= aims;
    if (aimed) bisections_left <= times;
    else if (answered) bisections_left <= bisections_left - 6'd1;
  end

  // ---- The end of the walk.
  logic put;
  logic [1:0] put_hit;
  logic signed [W-1:0] put_x, put_z;
  logic [25:0] put_steps;

  walk_end #(.W(W), .POINT(POINT), .CELL(CELL)) walk_end (
      .base(base), .last(last), .beyond_sky(beyond_sky), .east(east), .south(south),
      .map_ends(map_ends), .void_bits(void_bits),
      .starts(starts), .waits(waits), .streams(streams), .places(state == PLACE),
      .entry(entry), .falls(backward[1]), .place_over(place_over),
      .bounded(bound_valid), .clear(clear), .ahead_over(ahead_over),
      .answered(answered), .hits(hits), .answer_exists(answer_exists),
      .tag_last(tag_last), .tag_over(tag_over), .remaining(remaining),
      .remaining_next(remaining_next), .remaining_ahead(remaining_ahead),
      .place_x(place_x), .place_z(place_z), .ahead_x(ahead_x), .ahead_z(ahead_z),
      .follow_x(follow_x), .follow_z(follow_z), .met_x(met_x), .met_y(met_y), .met_z(met_z),
      .clear_exists(clear_exists), .middle_exists(middle_exists),
      .put(put), .put_hit(put_hit), .put_x(put_x), .put_z(put_z), .put_steps(put_steps));

  // ---- What happens next.
  always_comb begin
    case (state)
      SAMPLE: ends = answered && (hits || put || tag_last);
      HALVE: ends = answered;
      RIM: ends = answered && rim_answered;
      default: ends = 1'b0;
    endcase
  end

  always_ff @(posedge clock) begin
    if (reset) begin
      state <= IDLE;
    end else begin
      case (state)
        IDLE: if (in_valid && in_ready) state <= SCALE;
        SCALE: state <= STEP;
        STEP: state <= START;
        START: state <= put ? IDLE : walk_on;
        SKIP: state <= BOUND;
        BOUND: if (bound_valid) state <= put ? IDLE : walk_on;
        SAMPLE: if (ends) state <= hits ? AIM : put ? IDLE : walk_on;
        AIM: state <= bisects ? HALVE : void_bits ? RIM : PLACE;
        HALVE: if (ends && bisections_left == 6'd1) state <= void_bits ? RIM : PLACE;
        RIM: if (ends) state <= PLACE;
        default: state <= IDLE;
      endcase
    end
  end

  // ---- Items.
  logic room;
  credit #(.COUNT(2)) credits (
      .clock(clock), .reset(reset), .depth(2'(DEPTH)),
      .enter(in_valid && in_ready), .leave(out_valid && out_ready), .room(room));
  assign in_ready = takes && room;
  queue #(.WIDTH(2 + 2 * W + 26), .DEPTH(DEPTH)) results (
      .clock(clock), .reset(reset), .put(put), .in_item({put_hit, put_x, put_z, put_steps}),
      .out_valid(out_valid), .out_ready(out_ready),
      .out_item({out_hit, out_ground_x, out_ground_z, out_steps}));
endmodule
