// The stepper never jumps over a sample that it must test: properties bound into the stepper itself.
//
// PART 0, invariants of the state machine, by induction over the cycles, for words of full width:
//
//   - steps cover at most 2^-k cells per axis (equation 20);
//   - a jump of level m is J = 2^(m+k) steps, and is only tried where J samples remain, so that it
//     never passes the last one; `remaining` is never more than `last`, and 0 only where a walk ends;
//   - the place ahead is J steps ahead, and the bound that is asked for is that of the place where the
//     jump starts, of the jump's level.
//
// PART 1, one jump, with these invariants assumed: where the stepper takes a jump over a bound, it
// would have found every sample in between at or above the bound. Samples are reached here step by
// step, by the additions of the plain stepper. Bounded: jumps of J up to JUMP steps.
//
// That every node of the samples' surfaces is among those of the bound is shown in
// pyramid_axis_formal.sv. Assumed are: coefficients do not change, k <= 6, levels up to 20 (the plan);
// answers of a burst come in order, the last one with its tag (the interpolator's contract); in PART 1
// that the ray's height does not wrap (equation 32).
module stepper_formal #(
    parameter int WIDE = 0,
    parameter int PART = 0,
    parameter int JUMP = 4
) (
    input logic                                    clock,
    input logic                                    reset,
    input logic        [                      2:0] fineness,
    input logic        [                     25:0] last,
    input logic                                    skipping,
    input logic        [                      4:0] pyramid_top,
    input logic        [(WIDE == 1 ? 26 : 12)-1:0] map_columns,
    input logic        [(WIDE == 1 ? 26 : 12)-1:0] map_rows,
    input logic                                    map_ends,
    input logic        [                      3:0] state,
    input logic signed [(WIDE == 1 ? 64 : 32)-1:0] view_x,
    input logic signed [(WIDE == 1 ? 64 : 32)-1:0] view_y,
    input logic signed [(WIDE == 1 ? 64 : 32)-1:0] view_z,
    input logic        [(WIDE == 1 ? 64 : 32)-1:0] longest,
    input logic signed [                      7:0] right,
    input logic signed [(WIDE == 1 ? 64 : 32)-1:0] step_x,
    input logic signed [(WIDE == 1 ? 64 : 32)-1:0] step_y,
    input logic signed [(WIDE == 1 ? 64 : 32)-1:0] step_z,
    input logic signed [(WIDE == 1 ? 64 : 32)-1:0] place_x,
    input logic signed [(WIDE == 1 ? 64 : 32)-1:0] place_y,
    input logic signed [(WIDE == 1 ? 64 : 32)-1:0] place_z,
    input logic signed [(WIDE == 1 ? 64 : 32)-1:0] ahead_x,
    input logic signed [(WIDE == 1 ? 64 : 32)-1:0] ahead_y,
    input logic signed [(WIDE == 1 ? 64 : 32)-1:0] ahead_z,
    input logic        [                     25:0] remaining,
    input logic        [                     25:0] remaining_ahead,
    input logic signed [                      7:0] ahead_leading,
    input logic        [                      4:0] level,
    input logic                                    none,
    input logic                                    clear,
    input logic        [(WIDE == 1 ? 26 : 12)-1:0] bound_column,
    input logic        [(WIDE == 1 ? 26 : 12)-1:0] bound_row,
    input logic                                    bound_valid,
    input logic signed [(WIDE == 1 ? 64 : 32)-1:0] bound,
    input logic                                    answered,
    input logic                                    tag_last,
    input logic        [                      6:0] to_issue
);
  localparam int W = WIDE == 1 ? terraline_pkg::WIDE_WIDTH : terraline_pkg::NARROW_WIDTH;
  localparam int POINT = WIDE == 1 ? terraline_pkg::WIDE_POINT : terraline_pkg::NARROW_POINT;
  localparam int CELL = WIDE == 1 ? 26 : 12;
  localparam logic [3:0] SCALE = 4'd1, STEP = 4'd2, SKIP = 4'd4, BOUND = 4'd5,
                         SAMPLE = 4'd6;
  localparam logic [25:0] ONE = 26'd1;

  logic jumps;  // a jump is tried
  logic [5:0] jump_places;
  logic [26:0] jump_length;
  assign jumps = state == SKIP || state == BOUND;
  assign jump_places = {1'b0, level} + {3'b0, fineness};
  assign jump_length = 27'd1 << jump_places;

  // Steps.
  logic signed [W-1:0] most;
  logic steps_short;
  assign most = W'(1) << (8'(POINT) - {5'b0, fineness});
  assign steps_short = -most <= step_x && step_x <= most && -most <= step_y && step_y <= most
      && -most <= step_z && step_z <= most;

  // The place ahead.
  logic ahead_right;
  assign ahead_right = ahead_x == place_x + (step_x <<< jump_places)
      && ahead_y == place_y + (step_y <<< jump_places)
      && ahead_z == place_z + (step_z <<< jump_places);

  always_comb assume (fineness <= 3'd6 && pyramid_top <= 5'd20);

  generate
    if (PART == 0) begin : gen_invariants
      logic first;
      logic [2:0] fineness_before;
      logic [4:0] top_before;
      logic [25:0] last_before;
      logic skipping_before, ends_before;
      logic [CELL-1:0] columns_before, rows_before;
      // Samples of the burst in work, and how many of them are answered.
      logic [6:0] burst_size, burst_done;
      logic [3:0] state_before;
      initial first = 1'b1;
      always_ff @(posedge clock) begin
        first <= 1'b0;
        fineness_before <= fineness;
        top_before <= pyramid_top;
        last_before <= last;
        skipping_before <= skipping;
        ends_before <= map_ends;
        columns_before <= map_columns;
        rows_before <= map_rows;
      end
      always_comb begin
        assume (fineness == fineness_before && pyramid_top == top_before && last == last_before);
        assume (skipping == skipping_before && map_ends == ends_before);
        assume (map_columns == columns_before && map_rows == rows_before);
        if (first) assume (reset);
      end

      // The step that is made is short, as ray_step_formal.sv shows it, if `right` is.
      logic [W-1:0] magnitude_x, magnitude_y, magnitude_z;
      logic signed [7:0] leading;
      assign magnitude_x = view_x < 0 ? -view_x : view_x;
      assign magnitude_y = view_y < 0 ? -view_y : view_y;
      assign magnitude_z = view_z < 0 ? -view_z : view_z;
      leading_one #(
          .W(W)
      ) leading_view (
          .word(magnitude_x | magnitude_y | magnitude_z),
          .place(leading)
      );

      // Where the next jump is shorter than this one, the leading one of what remains says how long.
      logic signed [7:0] left_leading;
      leading_one #(
          .W(26)
      ) leading_left (
          .word(remaining_ahead),
          .place(left_leading)
      );

      // A burst of samples starts when none is in work: in its first cycle nothing is answered.
      logic fresh;
      always_ff @(posedge clock) begin
        state_before <= state;
        fresh <= state != SAMPLE || (answered && tag_last);
        if (fresh) burst_size <= to_issue;
        burst_done <= fresh ? {6'b0, answered} : burst_done + {6'b0, answered};
      end
      logic [6:0] size, done;
      assign size = fresh ? to_issue : burst_size;
      assign done = fresh ? '0 : burst_done;

      logic none_x, none_z;
      logic [CELL-1:0] stored_x, stored_z;
      pyramid_axis #(
          .CELL(CELL)
      ) axis_x (
          .nodes(map_columns),
          .ends(map_ends),
          .level(level),
          .cell_index(place_x[POINT+:CELL]),
          .stored(stored_x),
          .none(none_x)
      );
      pyramid_axis #(
          .CELL(CELL)
      ) axis_z (
          .nodes(map_rows),
          .ends(map_ends),
          .level(level),
          .cell_index(place_z[POINT+:CELL]),
          .stored(stored_z),
          .none(none_z)
      );

      always_comb begin
        if (state == SAMPLE && answered) assume (tag_last == (done + 7'd1 == size));
        if (!first) begin
          if (state == SCALE) assert (longest == (magnitude_x | magnitude_y | magnitude_z));
          if (state == STEP) begin
            assert (right == leading + $signed({5'b0, fineness}) - 8'(POINT));
          end
          if (state > STEP) assert (steps_short);
          if (jumps) begin
            assert (jump_length <= {1'b0, remaining});
            assert (skipping && level <= pyramid_top);
          end
          if (jumps || state == SAMPLE) assert (remaining != '0 && remaining <= last);
          if (state == SAMPLE) begin
            assert (done < size && size <= 7'd64);
            assert ({20'b0, size} <= {1'b0, remaining} + {20'b0, done});
          end
          if (state == SKIP) assert (bound_column == stored_x && bound_row == stored_z);
          if (state == BOUND) begin
            assert (ahead_right);
            assert ({1'b0, remaining_ahead} + jump_length == {1'b0, remaining});
            assert (none == (none_x || none_z));
            if ({1'b0, remaining_ahead} < jump_length) assert (ahead_leading == left_leading);
          end
        end
      end
    end else begin : gen_jump
      // Heights of the samples, one addition each.
      logic [JUMP*W-1:0] heights;
      logic signed [W:0] wide_ahead;
      assign wide_ahead = (W + 1)'(place_y) + ((W + 1)'(step_y) <<< jump_places);
      always_comb begin
        assume (state == BOUND && bound_valid && clear && !none);
        assume (steps_short && ahead_right && jump_length <= 27'(JUMP));
        assume (wide_ahead[W] == wide_ahead[W-1]);
      end
      for (genvar n = 1; n < JUMP; n++) begin : gen_sample
        logic signed [W-1:0] before, height;
        if (n == 1) assign before = place_y;
        else assign before = heights[(n-1)*W+:W];
        assign height = before + step_y;
        assign heights[n*W+:W] = height;
        always_comb if (27'(n) < jump_length) assert (height >= bound);
      end
    end
  endgenerate

  // Cases that must be possible.
  (* keep *) logic cover_far, cover_jump, cover_level, cover_burst;
  assign cover_far = state == BOUND && level == 5'd9 && fineness == 3'd5;
  assign cover_jump = state == BOUND && bound_valid && clear && !none && step_y < 0
      && jump_length == 27'(JUMP);
  assign cover_level = jumps && level == 5'd20;
  assign cover_burst = state == SAMPLE && answered && to_issue == 7'd3;
endmodule

bind stepper stepper_formal #(
    .WIDE(WIDE),
    .PART(PART),
    .JUMP(JUMP)
) properties (
    .*
);
