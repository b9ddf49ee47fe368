// The ray stepper: the first sample of a ray under the surface (docs/units/stepper.md).
//
// One ray at a time, as a state machine; its work on a ray takes
// 4 + trials (1 + M) + samples R + groups (N + 5) + halvings (R + N + 5) + hits 2 cycles with
// N = max(M, 2), on maps with holes 2 R + N + 5 more per hit (docs/cycles.md). The places of the walk are in
// three `ray_axis`, the count of its samples in `walk_plan`: here is what happens when.
//
// Never wraps a position (the plan proves their range), never passes a sample that might hit, never
// multiplies.
module stepper #(
    parameter int WIDE = 0  // words of 64 bits, not 32
) (
    input  logic                                    clock,
    input  logic                                    reset,           // forgets all rays
    // Coefficients
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] eye_x,           // the eye, x in cells
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] eye_y,           // y in height units
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] eye_z,           // z in cells
    input  logic                                    from_eye,        // rays start at the eye
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] highest,         // the highest node
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] base,            // base of the block under the map
    input  logic        [                      2:0] fineness,        // k: steps of at most 2^-k cells
    input  logic        [                     25:0] last,            // index of the last sample
    input  logic                                    halvings_fixed,  // always halvings_cap halvings
    input  logic signed [                      7:0] halvings_bias,   // halvings at distance one
    input  logic        [                      5:0] halvings_cap,    // most halvings
    input  logic                                    skipping,        // the pyramid is fitted
    input  logic        [                      4:0] pyramid_top,     // its highest level
    input  logic                                    beyond_sky,      // out of range is sky, not far
    input  logic        [(WIDE == 1 ? 26 : 12)-1:0] map_columns,     // nodes in x
    input  logic        [(WIDE == 1 ? 26 : 12)-1:0] map_rows,        // nodes in z
    input  logic                                    map_ends,        // the map ends at its edge
    input  logic                                    sides,           // the map has sides
    input  logic                                    void_bits,       // nodes may have no data
    // Items from the divider, or from the projector where rays start at the eye
    input  logic                                    in_valid,        // an item is there
    output logic                                    in_ready,        // it is taken at this edge
    input  logic        [                      1:0] in_entry,        // 0 met, 1 sky, 2 far
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] in_view_x,       // view vector, x
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] in_view_y,       // y
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] in_view_z,       // z
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] in_ground_x,     // where the ray enters, x
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] in_ground_z,     // z
    // Memory of the pyramid's bounds
    output logic                                    bound_read,      // an address is there
    output logic        [                      4:0] bound_level,     // level
    output logic        [(WIDE == 1 ? 26 : 12)-1:0] bound_column,    // stored bound, x
    output logic        [(WIDE == 1 ? 26 : 12)-1:0] bound_row,       // z
    input  logic                                    bound_valid,     // M cycles later: the bound is there
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] bound,           // height units
    // Samples to the interpolation, and its answers
    output logic                                    sample_valid,    // a sample is there
    output logic                                    sample_first,    // in its first cycle
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] sample_x,        // place, x
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] sample_z,        // z
    output logic        [                      2:0] sample_tag,      // goes along
    input  logic                                    sample_last,     // in its last cycle
    input  logic                                    answer_valid,    // an answer is there
    input  logic                                    answer_exists,   // there is a surface at the place
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] answer_surface,  // its height
    input  logic        [                      2:0] answer_tag,      // came along
    // Items to the interpolator
    output logic                                    out_valid,       // an item is there
    input  logic                                    out_ready,       // it is taken at this edge
    output logic        [                      1:0] out_hit,         // 0 sky, 1 surface, 2 side, 3 far
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] out_ground_x,    // place of the hit, x
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] out_ground_z,    // z
    output logic        [                     25:0] out_steps        // index of the sample that hit
);
  localparam int W = WIDE == 1 ? terraline_pkg::WIDE_WIDTH : terraline_pkg::NARROW_WIDTH;
  localparam int POINT = WIDE == 1 ? terraline_pkg::WIDE_POINT : terraline_pkg::NARROW_POINT;
  localparam int CELL = WIDE == 1 ? 26 : 12;
  localparam int DEPTH = terraline_pkg::STEPPER_DEPTH;

  localparam logic [1:0] SKY = 2'd0, SURFACE = 2'd1, SIDE = 2'd2, FAR = 2'd3;
  localparam logic [1:0] ENTRY_MET = 2'd0, ENTRY_FAR = 2'd2;

  localparam logic [3:0] IDLE = 4'd0;  // waits for a ray, and takes it
  localparam logic [3:0] SCALE = 4'd1;  // finds its largest component
  localparam logic [3:0] STEP = 4'd2;  // makes its step
  localparam logic [3:0] START = 4'd3;  // starts its walk
  localparam logic [3:0] TRIAL = 4'd4;  // asks for a bound
  localparam logic [3:0] BOUND = 4'd5;  // waits for it, and jumps or not
  localparam logic [3:0] SAMPLE = 4'd6;  // a group of samples streams
  localparam logic [3:0] AIM = 4'd7;  // takes the distance of the hit
  localparam logic [3:0] HALVE = 4'd8;  // asks whether the middle hits
  localparam logic [3:0] RIM = 4'd9;  // asks whether there is a surface beside the hit
  localparam logic [3:0] PLACE = 4'd10;  // places the hit

  logic [3:0] state;

  // The ray.
  logic signed [W-1:0] view_x, view_y, view_z;
  logic signed [7:0] right;  // shift of the view vector to a step
  logic [1:0] entry;
  logic signed [W-1:0] step_x, step_y, step_z;
  logic [2:0] forward, backward;  // bits x, y, z: the step is not negative, not positive

  // The walk.
  logic signed [W-1:0] place_x, place_y, place_z;
  logic signed [W-1:0] follow_x, follow_y, follow_z;
  logic signed [W-1:0] issue_x, issue_y, issue_z;
  logic signed [W-1:0] ahead_x, ahead_y, ahead_z;
  logic signed [W-1:0] met_x, met_y, met_z;
  logic [25:0] remaining, remaining_next, remaining_ahead;
  logic [4:0] level;
  logic none;  // there is no bound
  logic [6:0] to_issue;  // samples of a group
  logic epoch;  // answers of another epoch are of no interest any more
  logic [5:0] halvings_left;
  logic issued;  // a halving's sample is on its way; at the rim: the first one
  logic issued_second;
  logic clear_exists, first_answered;

  // Cells of the map, of coefficients alone.
  logic signed [CELL-1:0] east, south;
  always_ff @(posedge clock) begin
    east <= $signed(map_columns) - CELL'(1);
    south <= $signed(map_rows) - CELL'(1);
  end

  // ---- The start: a step of the view vector (equation 20).
  logic [W-1:0] in_magnitude_x, in_magnitude_y, in_magnitude_z;
  logic [W-1:0] longest;  // has the leading one of the largest component
  logic signed [7:0] view_leading;
  logic signed [W-1:0] new_step_x, new_step_y, new_step_z;
  logic [2:0] new_forward, new_backward;
  logic start_over;

  assign in_magnitude_x = in_view_x < 0 ? -in_view_x : in_view_x;
  assign in_magnitude_y = in_view_y < 0 ? -in_view_y : in_view_y;
  assign in_magnitude_z = in_view_z < 0 ? -in_view_z : in_view_z;
  leading_one #(
      .W(W)
  ) leading_view (
      .word(longest),
      .place(view_leading)
  );
  ray_step #(
      .W(W),
      .POINT(POINT)
  ) ray_step_x (
      .view(view_x),
      .right(right),
      .step(new_step_x),
      .forward(new_forward[0]),
      .backward(new_backward[0])
  );
  ray_step #(
      .W(W),
      .POINT(POINT)
  ) ray_step_y (
      .view(view_y),
      .right(right),
      .step(new_step_y),
      .forward(new_forward[1]),
      .backward(new_backward[1])
  );
  ray_step #(
      .W(W),
      .POINT(POINT)
  ) ray_step_z (
      .view(view_z),
      .right(right),
      .step(new_step_z),
      .forward(new_forward[2]),
      .backward(new_backward[2])
  );
  ray_end #(
      .W(W),
      .CELL(CELL)
  ) end_at_start (
      .highest(highest),
      .base(base),
      .east(east),
      .south(south),
      .map_ends(map_ends),
      .sides(sides),
      .i(place_x[POINT+:CELL]),
      .y(place_y),
      .j(place_z[POINT+:CELL]),
      .forward(forward),
      .backward(backward),
      .over(start_over)
  );

  // ---- A trial: a jump of 2^(level+k) samples, if its bound allows it (equation 21).
  logic [5:0] jump_log2;
  logic pyramid_none;
  logic clear, ahead_over;

  pyramid #(
      .CELL(CELL)
  ) pyramid (
      .map_columns(map_columns),
      .map_rows(map_rows),
      .map_ends(map_ends),
      .level(level),
      .i(place_x[POINT+:CELL]),
      .j(place_z[POINT+:CELL]),
      .column(bound_column),
      .row(bound_row),
      .none(pyramid_none)
  );
  assign bound_read = state == TRIAL;
  assign bound_level = level;
  assign clear = none || (place_y >= bound && ahead_y >= bound);
  ray_end #(
      .W(W),
      .CELL(CELL)
  ) end_ahead (
      .highest(highest),
      .base(base),
      .east(east),
      .south(south),
      .map_ends(map_ends),
      .sides(sides),
      .i(ahead_x[POINT+:CELL]),
      .y(ahead_y),
      .j(ahead_z[POINT+:CELL]),
      .forward(forward),
      .backward(backward),
      .over(ahead_over)
  );

  // ---- Samples: `issue` runs ahead, `follow` and `place` come behind with the answers.
  logic issue_over, issuing;
  logic answered, hits;
  logic tag_last, tag_over;

  ray_end #(
      .W(W),
      .CELL(CELL)
  ) end_issued (
      .highest(highest),
      .base(base),
      .east(east),
      .south(south),
      .map_ends(map_ends),
      .sides(sides),
      .i(issue_x[POINT+:CELL]),
      .y(issue_y),
      .j(issue_z[POINT+:CELL]),
      .forward(forward),
      .backward(backward),
      .over(issue_over)
  );

  assign issuing = state == SAMPLE ? to_issue != '0
                 : state == HALVE ? !issued
                 : state == RIM && !issued_second;
  assign sample_valid = issuing;
  assign sample_tag = {epoch, to_issue == 7'd1, issue_over};
  always_comb begin
    if (state == SAMPLE) begin
      sample_x = issue_x;
      sample_z = issue_z;
    end else if (state == RIM && !issued) begin
      sample_x = place_x;
      sample_z = place_z;
    end else begin
      sample_x = follow_x;
      sample_z = follow_z;
    end
  end
  assign answered = answer_valid && answer_tag[2] == epoch;
  assign tag_last = answer_tag[1];
  assign tag_over = answer_tag[0];
  assign hits = answer_exists && follow_y < answer_surface;

  // A sample's first cycle follows the last one of the sample before.
  logic sampling;  // a sample is in its later cycles
  assign sample_first = !sampling;

  // ---- The walk.
  logic tests, moves, issues;

  assign tests = answered && (state == SAMPLE || state == HALVE);
  assign moves = (state == BOUND && bound_valid && clear) || (tests && !hits);
  assign issues = state == SAMPLE && issuing && sample_last;
  ray_axis #(
      .W(W)
  ) axis_x (
      .clock(clock),
      .step(step_x),
      .origin(from_eye ? eye_x : in_ground_x),
      .jump_log2(jump_log2),
      .takes(state == IDLE),
      .starts(state == START),
      .tries(state == TRIAL),
      .waits(state == BOUND),
      .issues(issues),
      .aims(state == AIM),
      .halves(state == HALVE),
      .answered(tests),
      .hits(hits),
      .moves(moves),
      .place(place_x),
      .follow(follow_x),
      .issue(issue_x),
      .ahead(ahead_x),
      .met(met_x)
  );
  ray_axis #(
      .W(W)
  ) axis_y (
      .clock(clock),
      .step(step_y),
      .origin(from_eye ? eye_y : highest),
      .jump_log2(jump_log2),
      .takes(state == IDLE),
      .starts(state == START),
      .tries(state == TRIAL),
      .waits(state == BOUND),
      .issues(issues),
      .aims(state == AIM),
      .halves(state == HALVE),
      .answered(tests),
      .hits(hits),
      .moves(moves),
      .place(place_y),
      .follow(follow_y),
      .issue(issue_y),
      .ahead(ahead_y),
      .met(met_y)
  );
  ray_axis #(
      .W(W)
  ) axis_z (
      .clock(clock),
      .step(step_z),
      .origin(from_eye ? eye_z : in_ground_z),
      .jump_log2(jump_log2),
      .takes(state == IDLE),
      .starts(state == START),
      .tries(state == TRIAL),
      .waits(state == BOUND),
      .issues(issues),
      .aims(state == AIM),
      .halves(state == HALVE),
      .answered(tests),
      .hits(hits),
      .moves(moves),
      .place(place_z),
      .follow(follow_z),
      .issue(issue_z),
      .ahead(ahead_z),
      .met(met_z)
  );

  logic signed [7:0] ahead_leading;
  logic trial_follows;
  logic [6:0] run;
  logic [3:0] walk_on;

  walk_plan plan (
      .clock(clock),
      .fineness(fineness),
      .last(last),
      .skipping(skipping),
      .pyramid_top(pyramid_top),
      .starts(state == START),
      .tries(state == TRIAL),
      .waits(state == BOUND),
      .bounded(bound_valid),
      .clear(clear),
      .passes(state == SAMPLE && answered),
      .ends_group(tag_last),
      .remaining(remaining),
      .remaining_next(remaining_next),
      .remaining_ahead(remaining_ahead),
      .ahead_leading(ahead_leading),
      .level(level),
      .jump_log2(jump_log2),
      .trial_follows(trial_follows),
      .run(run)
  );
  assign walk_on = trial_follows ? TRIAL : SAMPLE;

  // ---- The hit: its halvings (equation 22).
  logic halves;
  logic aimed;  // the first cycle of the halvings
  logic [5:0] times;

  halvings #(
      .W(W),
      .POINT(POINT)
  ) halvings (
      .clock(clock),
      .eye_x(eye_x),
      .eye_y(eye_y),
      .eye_z(eye_z),
      .fixed(halvings_fixed),
      .bias(halvings_bias),
      .cap(halvings_cap),
      .x(follow_x),
      .y(follow_y),
      .z(follow_z),
      .any(halves),
      .times(times)
  );

  // ---- Its place.
  logic signed [CELL-1:0] clear_i, clear_j, middle_i, middle_j;
  logic clear_on_map, middle_on_map;
  logic clear_there, middle_there, middle_exists;
  logic under_base;

  assign clear_i = place_x[POINT+:CELL];
  assign clear_j = place_z[POINT+:CELL];
  assign middle_i = follow_x[POINT+:CELL];
  assign middle_j = follow_z[POINT+:CELL];
  assign clear_on_map = !map_ends
      || (clear_i >= 0 && clear_i < east && clear_j >= 0 && clear_j < south);
  assign middle_on_map = !map_ends
      || (middle_i >= 0 && middle_i < east && middle_j >= 0 && middle_j < south);
  assign clear_there = void_bits ? clear_exists : clear_on_map;
  assign middle_there = void_bits ? middle_exists : middle_on_map;
  // A ray that does not rise meets nothing below the base.
  assign under_base = backward[1] && met_y < base;

  // ---- The end of a walk.
  logic put;
  logic [1:0] put_hit;
  logic signed [W-1:0] put_x, put_z;
  logic [25:0] put_steps;

  always_comb begin
    put = 1'b0;
    put_hit = SKY;
    put_x = place_x;
    put_z = place_z;
    put_steps = last - remaining;
    case (state)
      START: begin
        put_steps = '0;
        if (entry != ENTRY_MET) begin
          put = 1'b1;
          put_hit = entry == ENTRY_FAR && !beyond_sky ? FAR : SKY;
        end else if (start_over) begin
          put = 1'b1;
        end else if (last == '0) begin
          put = 1'b1;
          put_hit = FAR;
        end
      end
      BOUND: begin
        put_x = ahead_x;
        put_z = ahead_z;
        put_steps = last - remaining_ahead;
        put_hit = ahead_over ? SKY : FAR;
        put = bound_valid && clear && (ahead_over || remaining_ahead == '0);
      end
      SAMPLE: begin
        put_x = follow_x;
        put_z = follow_z;
        put_steps = last - remaining_next;
        put_hit = tag_over ? SKY : FAR;
        put = answered && !hits
            && (tag_last ? tag_over || remaining_next == '0 : tag_over && !answer_exists);
      end
      PLACE: begin
        put = 1'b1;
        if (clear_there) put_hit = SURFACE;
        // From beside the map or out of a hole: the side, down to the base.
        else put_hit = under_base ? SKY : SIDE;
        put_x = clear_there && middle_there ? follow_x : met_x;
        put_z = clear_there && middle_there ? follow_z : met_z;
      end
      default: ;
    endcase
  end

  always_ff @(posedge clock) begin
    if (reset) begin
      state <= IDLE;
      epoch <= 1'b0;
      sampling <= 1'b0;
    end else begin
      sampling <= issuing && !sample_last;
      case (state)
        IDLE: if (in_valid && in_ready) state <= SCALE;
        SCALE: state <= STEP;
        STEP: state <= START;
        START: state <= put ? IDLE : walk_on;
        TRIAL: state <= BOUND;
        BOUND: if (bound_valid) state <= put ? IDLE : walk_on;
        SAMPLE: begin
          if (answered) begin
            if (hits) state <= AIM;
            else if (put) state <= IDLE;
            else if (tag_last) state <= walk_on;
            // Whatever was issued behind the sample that ends the group is not looked at.
            if (hits || put || tag_last) begin
              epoch <= !epoch;
              sampling <= 1'b0;
            end
          end
        end
        AIM: state <= halves ? HALVE : void_bits ? RIM : PLACE;
        HALVE: begin
          if (answered) begin
            epoch <= !epoch;
            if (halvings_left == 6'd1) state <= void_bits ? RIM : PLACE;
          end
        end
        RIM: begin
          if (answered && first_answered) begin
            epoch <= !epoch;
            state <= PLACE;
          end
        end
        PLACE: state <= IDLE;
        default: state <= IDLE;
      endcase
    end
  end

  always_ff @(posedge clock) begin
    case (state)
      IDLE: begin
        view_x <= in_view_x;
        view_y <= in_view_y;
        view_z <= in_view_z;
        longest <= in_magnitude_x | in_magnitude_y | in_magnitude_z;
        entry <= from_eye ? ENTRY_MET : in_entry;
      end
      SCALE: right <= view_leading + $signed({5'b0, fineness}) - 8'(POINT);
      STEP: begin
        step_x <= new_step_x;
        step_y <= new_step_y;
        step_z <= new_step_z;
        forward <= new_forward;
        backward <= new_backward;
      end
      TRIAL: none <= pyramid_none;
      RIM: begin
        if (answered) begin
          if (first_answered) middle_exists <= answer_exists;
          else clear_exists <= answer_exists;
        end
      end
      default: ;
    endcase

    aimed <= state == AIM;
    if (aimed) halvings_left <= times;
    else if (answered) halvings_left <= halvings_left - 6'd1;

    // Samples to be issued: of a group, of a halving, of the rim.
    if (state == START || state == BOUND || (state == SAMPLE && answered && tag_last)) begin
      to_issue <= run;
    end else if (issues) begin
      to_issue <= to_issue - 7'd1;
    end
    if (state == HALVE && !answered) begin
      if (issuing && sample_last) issued <= 1'b1;
    end else if (state == RIM) begin
      if (issuing && sample_last) begin
        issued <= 1'b1;
        issued_second <= issued;
      end
      if (answered) first_answered <= 1'b1;
    end else begin
      issued <= 1'b0;
      issued_second <= 1'b0;
      first_answered <= 1'b0;
    end
  end

  // ---- Items.
  logic room;
  credit #(
      .COUNT(2)
  ) credits (
      .clock(clock),
      .reset(reset),
      .depth(2'(DEPTH)),
      .enter(in_valid && in_ready),
      .leave(out_valid && out_ready),
      .room(room)
  );
  assign in_ready = state == IDLE && room;
  queue #(
      .WIDTH(2 + 2 * W + 26),
      .DEPTH(DEPTH)
  ) results (
      .clock(clock),
      .reset(reset),
      .put(put),
      .in_item({put_hit, put_x, put_z, put_steps}),
      .out_valid(out_valid),
      .out_ready(out_ready),
      .out_item({out_hit, out_ground_x, out_ground_z, out_steps})
  );
endmodule
