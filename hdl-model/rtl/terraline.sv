// The processor: raster scan, projector, divider, and behind them stepper, interpolator and shader
// of a height map, or the checker of a plane. Pixels come out in scan order.
//
// Coefficients and tables are loaded, then `start` is given; the cycle after it is cycle 0. Heights
// and bounds of the pyramid lie in memories outside, which answer in order, M cycles after the
// address. The ports from `takes` on are probes: they say what passes between the units, and drive
// nothing in a machine.
module terraline #(
    parameter int WIDE = 0,          // words of 64 bits, not 32
    parameter int TERRAIN = 1,       // a height map, not a plane
    parameter int STRETCH = 0,       // kernels over 3x3 nodes, not 2x2
    parameter int SERIAL = 0,        // one stage for all quotient bits of the divider
    parameter int TABLE_LOG2 = 12,   // largest kernel table, as a power of two
    parameter int OUTSTANDING = 8,   // largest memory latency
    localparam int W = WIDE == 1 ? terraline_pkg::WIDE_WIDTH : terraline_pkg::NARROW_WIDTH,
    localparam int CELL = WIDE == 1 ? 26 : 12,  // bits of a cell's index
    localparam int BANK = CELL - 1              // bits of an address in a bank, per axis
) (
    input  logic                clock,
    input  logic                reset,             // no frame is drawn
    // Loading
    input  logic                load,              // take `load_data` at this edge
    input  logic        [  2:0] load_space,        // 0 coefficient, 1 kernel's weights, 2 its slopes,
                                                   // 3 reciprocal square roots, 4 ramp
    input  logic        [ 16:0] load_address,      // coefficient, or entry of the table
    input  logic        [W-1:0] load_data,         // word
    input  logic                start,             // a frame begins in the next cycle
    // Memory of the pyramid's bounds
    output logic                bound_read,        // an address is there
    output logic [         4:0] bound_level,       // level
    output logic [    CELL-1:0] bound_column,      // stored bound, x
    output logic [    CELL-1:0] bound_row,         // z
    input  logic                bound_valid,       // the bound is there
    input  logic        [W-1:0] bound,             // height units
    // Memory of heights, port of the stepper's samples: four banks by (i & 1, j & 1)
    output logic                sample_read,       // addresses are there
    output logic [  4*BANK-1:0] sample_column,     // i >> 1 per bank, bank 0 lowest
    output logic [  4*BANK-1:0] sample_row,        // j >> 1 per bank
    input  logic                sample_data_valid, // the nodes are there
    input  logic [     4*W-1:0] sample_data,       // a node per bank
    input  logic [         3:0] sample_void,       // it has no data
    // The same memory, port of the hits
    output logic                hit_read,          // addresses are there
    output logic [  4*BANK-1:0] hit_column,        // i >> 1 per bank
    output logic [  4*BANK-1:0] hit_row,           // j >> 1 per bank
    input  logic                hit_data_valid,    // the nodes are there
    input  logic [     4*W-1:0] hit_data,          // a node per bank
    input  logic [         3:0] hit_void,          // it has no data
    // Pixels
    output logic                pixel_valid,       // a pixel is there
    input  logic                pixel_ready,       // it is taken at this edge
    output logic [        23:0] pixel_color,       // sRGB bytes, red in the low byte
    // Probes
    output logic [         5:0] takes,             // units that take an item at this edge: projector,
                                                   // divider, stepper, interpolator, shader, frame
    output logic [         5:0] waits,             // units before which an item waits
    output logic [       W-1:0] view_x,            // from the projector: view vector, x
    output logic [       W-1:0] view_y,            // y
    output logic [       W-1:0] view_z,            // z
    output logic [       W-1:0] denominator,       // denominator
    output logic [         1:0] entry,             // from the divider: 0 met, 1 sky, 2 out of range
    output logic [       W-1:0] entry_x,           // where the ray enters, x
    output logic [       W-1:0] entry_z,           // z
    output logic [         1:0] stepper_hit,          // from the stepper: 0 sky, 1 surface, 2 side, 3 out of range
    output logic [       W-1:0] ground_x,          // place of the hit, x
    output logic [       W-1:0] ground_z,          // z
    output logic [        25:0] steps,             // index of the sample that hit
    output logic [         1:0] interpolator_hit,       // from the interpolator: outcome
    output logic [       W-1:0] surface,           // surface height
    output logic [       W-1:0] slope_x,           // slope against x, negated
    output logic [       W-1:0] slope_z,           // against z
    output logic [         1:0] shader_hit          // from the shader: outcome
);
  localparam int PROJECTOR = 0, DIVIDER = 1, STEPPER = 2, INTERPOLATOR = 3, SHADER = 4, FRAME = 5;

  // ---- Coefficients
  logic [15:0] columns;
  logic [15:0] lines;
  logic signed [W-1:0] view_x_start;
  logic signed [W-1:0] view_x_per_line;
  logic signed [W-1:0] view_x_per_column;
  logic signed [W-1:0] view_y_start;
  logic signed [W-1:0] view_y_per_line;
  logic signed [W-1:0] view_y_per_column;
  logic signed [W-1:0] view_z_start;
  logic signed [W-1:0] view_z_per_line;
  logic signed [W-1:0] view_z_per_column;
  logic signed [W-1:0] denominator_start;
  logic signed [W-1:0] denominator_per_line;
  logic signed [W-1:0] denominator_per_column;
  logic signed [W-1:0] eye_x;
  logic signed [W-1:0] eye_z;
  logic signed [7:0] ratio_shift_x;
  logic [5:0] ratio_bits_x;
  logic from_eye;

  registers_front #(
      .WIDE(WIDE)
  ) front (
      .clock(clock),
      .load(load && load_space == 3'd0),
      .load_address(load_address[15:0]),
      .load_data(load_data),
      .columns(columns),
      .lines(lines),
      .view_x_start(view_x_start),
      .view_x_per_line(view_x_per_line),
      .view_x_per_column(view_x_per_column),
      .view_y_start(view_y_start),
      .view_y_per_line(view_y_per_line),
      .view_y_per_column(view_y_per_column),
      .view_z_start(view_z_start),
      .view_z_per_line(view_z_per_line),
      .view_z_per_column(view_z_per_column),
      .denominator_start(denominator_start),
      .denominator_per_line(denominator_per_line),
      .denominator_per_column(denominator_per_column),
      .eye_x(eye_x),
      .eye_z(eye_z),
      .ratio_shift_x(ratio_shift_x),
      .ratio_bits_x(ratio_bits_x),
      .from_eye(from_eye)
  );

  // ---- Raster scan and projector
  logic running, last_column, step;
  logic view_valid, view_ready;

  raster raster (
      .clock(clock),
      .reset(reset),
      .start(start),
      .columns(columns),
      .lines(lines),
      .step(step),
      .running(running),
      .last_column(last_column)
  );
  projector #(
      .WIDE(WIDE)
  ) projector (
      .clock(clock),
      .reset(reset),
      .start(start),
      .running(running),
      .last_column(last_column),
      .step(step),
      .view_x_start(view_x_start),
      .view_x_per_line(view_x_per_line),
      .view_x_per_column(view_x_per_column),
      .view_y_start(view_y_start),
      .view_y_per_line(view_y_per_line),
      .view_y_per_column(view_y_per_column),
      .view_z_start(view_z_start),
      .view_z_per_line(view_z_per_line),
      .view_z_per_column(view_z_per_column),
      .denominator_start(denominator_start),
      .denominator_per_line(denominator_per_line),
      .denominator_per_column(denominator_per_column),
      .out_valid(view_valid),
      .out_ready(view_ready),
      .out_view_x(view_x),
      .out_view_y(view_y),
      .out_view_z(view_z),
      .out_denominator(denominator)
  );
  assign takes[PROJECTOR] = step;
  assign waits[PROJECTOR] = running && !step;

  // ---- Divider; rays from the eye pass it by
  localparam int SIDE = TERRAIN == 1 ? 3 * W : W;
  logic divider_valid, divider_ready, entry_valid, entry_ready;
  logic [SIDE-1:0] divider_side, entry_side;

  assign divider_valid = view_valid && !from_eye;
  divider #(
      .WIDE(WIDE),
      .SERIAL(SERIAL),
      .SIDE(SIDE)
  ) divider (
      .clock(clock),
      .reset(reset),
      .eye_x(eye_x),
      .eye_z(eye_z),
      .ratio_shift(ratio_shift_x),
      .ratio_bits(ratio_bits_x),
      .in_valid(divider_valid),
      .in_ready(divider_ready),
      .in_view_x(view_x),
      .in_view_z(view_z),
      .in_denominator(denominator),
      .in_side(divider_side),
      .out_valid(entry_valid),
      .out_ready(entry_ready),
      .out_entry(entry),
      .out_ground_x(entry_x),
      .out_ground_z(entry_z),
      .out_side(entry_side)
  );
  assign takes[DIVIDER] = divider_valid && divider_ready;
  assign waits[DIVIDER] = divider_valid && !divider_ready;

  if (TERRAIN == 1) begin : terrain
    // ---- Coefficients of a height map
    logic [CELL-1:0] map_columns;
    logic [CELL-1:0] map_rows;
    logic [1:0] map_edge;
    logic void_bits;
    logic [1:0] form;
    logic [5:0] deformation_shift;
    logic [4:0] kernel_log2;
    logic slope_scaled;
    logic signed [W-1:0] slope_scale_x;
    logic signed [W-1:0] slope_scale_z;
    logic [6:0] memory_latency;

    registers_map #(
        .WIDE(WIDE)
    ) map (
        .clock(clock),
        .load(load && load_space == 3'd0),
        .load_address(load_address[15:0]),
        .load_data(load_data),
        .map_columns(map_columns),
        .map_rows(map_rows),
        .map_edge(map_edge),
        .void_bits(void_bits),
        .form(form),
        .deformation_shift(deformation_shift),
        .kernel_log2(kernel_log2),
        .slope_scaled(slope_scaled),
        .slope_scale_x(slope_scale_x),
        .slope_scale_z(slope_scale_z),
        .memory_latency(memory_latency)
    );

    logic signed [W-1:0] eye_y;
    logic signed [W-1:0] highest;
    logic signed [W-1:0] base;
    logic [2:0] fineness;
    logic [25:0] last;
    logic bisection_fixed;
    logic signed [7:0] bisection_bias;
    logic [5:0] bisection_cap;
    logic skipping;
    logic [4:0] pyramid_top;
    logic beyond_sky;
    logic sides;

    registers_walk #(
        .WIDE(WIDE)
    ) walk (
        .clock(clock),
        .load(load && load_space == 3'd0),
        .load_address(load_address[15:0]),
        .load_data(load_data),
        .eye_y(eye_y),
        .highest(highest),
        .base(base),
        .fineness(fineness),
        .last(last),
        .bisection_fixed(bisection_fixed),
        .bisection_bias(bisection_bias),
        .bisection_cap(bisection_cap),
        .skipping(skipping),
        .pyramid_top(pyramid_top),
        .beyond_sky(beyond_sky),
        .sides(sides)
    );

    logic [23:0] sky_color;
    logic [23:0] out_of_range_color;
    logic [23:0] side_color;
    logic lit;
    logic signed [W-1:0] light_x;
    logic signed [W-1:0] light_y;
    logic signed [W-1:0] light_z;
    logic signed [W-1:0] ambient;
    logic signed [7:0] ramp_exponent;
    logic signed [W-1:0] ramp_gain;
    logic [3:0] ramp_last;

    registers_shader #(
        .WIDE(WIDE)
    ) colors (
        .clock(clock),
        .load(load && load_space == 3'd0),
        .load_address(load_address[15:0]),
        .load_data(load_data),
        .sky_color(sky_color),
        .out_of_range_color(out_of_range_color),
        .side_color(side_color),
        .lit(lit),
        .light_x(light_x),
        .light_y(light_y),
        .light_z(light_z),
        .ambient(ambient),
        .ramp_exponent(ramp_exponent),
        .ramp_gain(ramp_gain),
        .ramp_last(ramp_last)
    );

    // ---- Stepper, with an interpolation of its own for its samples
    logic ray_valid, ray_ready, walk_valid, walk_ready;
    logic [W-1:0] ray_x, ray_y, ray_z;
    logic sample_valid, sample_first, sample_last, sample_answered, sample_exists;
    logic [W-1:0] sample_x, sample_z, sample_surface;
    logic [2:0] sample_tag, sample_answer_tag;

    assign divider_side = {view_x, view_y, view_z};
    assign ray_valid = from_eye ? view_valid : entry_valid;
    assign {ray_x, ray_y, ray_z} = from_eye ? divider_side : entry_side;
    assign entry_ready = ray_ready && !from_eye;
    assign view_ready = from_eye ? ray_ready : divider_ready;
    stepper #(
        .WIDE(WIDE)
    ) stepper (
        .clock(clock),
        .reset(reset),
        .eye_x(eye_x),
        .eye_y(eye_y),
        .eye_z(eye_z),
        .from_eye(from_eye),
        .highest(highest),
        .base(base),
        .fineness(fineness),
        .last(last),
        .bisection_fixed(bisection_fixed),
        .bisection_bias(bisection_bias),
        .bisection_cap(bisection_cap),
        .skipping(skipping),
        .pyramid_top(pyramid_top),
        .beyond_sky(beyond_sky),
        .map_columns(map_columns),
        .map_rows(map_rows),
        .map_ends(map_edge == 2'd0),
        .sides(sides),
        .void_bits(void_bits),
        .in_valid(ray_valid),
        .in_ready(ray_ready),
        .in_entry(entry),
        .in_view_x(ray_x),
        .in_view_y(ray_y),
        .in_view_z(ray_z),
        .in_ground_x(entry_x),
        .in_ground_z(entry_z),
        .bound_read(bound_read),
        .bound_level(bound_level),
        .bound_column(bound_column),
        .bound_row(bound_row),
        .bound_valid(bound_valid),
        .bound(bound),
        .sample_valid(sample_valid),
        .sample_first(sample_first),
        .sample_x(sample_x),
        .sample_z(sample_z),
        .sample_tag(sample_tag),
        .sample_last(sample_last),
        .answer_valid(sample_answered),
        .answer_exists(sample_exists),
        .answer_surface(sample_surface),
        .answer_tag(sample_answer_tag),
        .out_valid(walk_valid),
        .out_ready(walk_ready),
        .out_hit(stepper_hit),
        .out_ground_x(ground_x),
        .out_ground_z(ground_z),
        .out_steps(steps)
    );
    interpolator #(
        .WIDE(WIDE),
        .STRETCH(STRETCH),
        .SLOPES(0),
        .TAG(3),
        .TABLE_LOG2(TABLE_LOG2),
        .OUTSTANDING(OUTSTANDING)
    ) sampling (
        .clock(clock),
        .reset(reset),
        .form(form),
        .deformation_shift(deformation_shift),
        .table_log2(kernel_log2),
        .map_columns(map_columns),
        .map_rows(map_rows),
        .map_ends(map_edge == 2'd0),
        .void_bits(void_bits),
        .slope_scaled(1'b0),
        .slope_scale_x(W'(0)),
        .slope_scale_z(W'(0)),
        .load_weight(load && load_space == 3'd1),
        .load_slope(1'b0),
        .load_address(load_address),
        .load_data(load_data),
        .request_valid(sample_valid),
        .request_first(sample_first),
        .request_last(sample_last),
        .request_x(sample_x),
        .request_z(sample_z),
        .request_tag(sample_tag),
        .read(sample_read),
        .read_column(sample_column),
        .read_row(sample_row),
        .data_valid(sample_data_valid),
        .data(sample_data),
        .data_void(sample_void),
        .answer_valid(sample_answered),
        .answer_exists(sample_exists),
        .answer_surface(sample_surface),
        .answer_slope_x(),
        .answer_slope_z(),
        .answer_tag(sample_answer_tag)
    );
    assign takes[STEPPER] = ray_valid && ray_ready;
    assign waits[STEPPER] = ray_valid && !ray_ready;

    // ---- Interpolator at the hit
    logic place_valid, place_first, place_last, place_answered;
    logic [W-1:0] place_x, place_z, place_surface, place_slope_x, place_slope_z;
    logic [1:0] place_tag, place_answer_tag;
    logic surface_valid, surface_ready;

    surface_stage #(
        .WIDE(WIDE),
        .OUTSTANDING(OUTSTANDING)
    ) surface_stage (
        .clock(clock),
        .reset(reset),
        .memory_latency(memory_latency),
        .in_valid(walk_valid),
        .in_ready(walk_ready),
        .in_hit(stepper_hit),
        .in_ground_x(ground_x),
        .in_ground_z(ground_z),
        .request_valid(place_valid),
        .request_first(place_first),
        .request_last(place_last),
        .request_x(place_x),
        .request_z(place_z),
        .request_tag(place_tag),
        .answer_valid(place_answered),
        .answer_surface(place_surface),
        .answer_slope_x(place_slope_x),
        .answer_slope_z(place_slope_z),
        .answer_tag(place_answer_tag),
        .out_valid(surface_valid),
        .out_ready(surface_ready),
        .out_hit(interpolator_hit),
        .out_surface(surface),
        .out_slope_x(slope_x),
        .out_slope_z(slope_z)
    );
    interpolator #(
        .WIDE(WIDE),
        .STRETCH(STRETCH),
        .SLOPES(1),
        .TAG(2),
        .TABLE_LOG2(TABLE_LOG2),
        .OUTSTANDING(OUTSTANDING)
    ) interpolator (
        .clock(clock),
        .reset(reset),
        .form(form),
        .deformation_shift(deformation_shift),
        .table_log2(kernel_log2),
        .map_columns(map_columns),
        .map_rows(map_rows),
        .map_ends(map_edge == 2'd0),
        .void_bits(void_bits),
        .slope_scaled(slope_scaled),
        .slope_scale_x(slope_scale_x),
        .slope_scale_z(slope_scale_z),
        .load_weight(load && load_space == 3'd1),
        .load_slope(load && load_space == 3'd2),
        .load_address(load_address),
        .load_data(load_data),
        .request_valid(place_valid),
        .request_first(place_first),
        .request_last(place_last),
        .request_x(place_x),
        .request_z(place_z),
        .request_tag(place_tag),
        .read(hit_read),
        .read_column(hit_column),
        .read_row(hit_row),
        .data_valid(hit_data_valid),
        .data(hit_data),
        .data_void(hit_void),
        .answer_valid(place_answered),
        .answer_exists(),
        .answer_surface(place_surface),
        .answer_slope_x(place_slope_x),
        .answer_slope_z(place_slope_z),
        .answer_tag(place_answer_tag)
    );
    assign takes[INTERPOLATOR] = walk_valid && walk_ready;
    assign waits[INTERPOLATOR] = walk_valid && !walk_ready;

    // ---- Shader
    shader #(
        .WIDE(WIDE)
    ) shader (
        .clock(clock),
        .reset(reset),
        .sky_color(sky_color),
        .out_of_range_color(out_of_range_color),
        .side_color(side_color),
        .lit(lit),
        .toward_x(light_x),
        .toward_y(light_y),
        .toward_z(light_z),
        .ambient(ambient),
        .ramp_exponent(ramp_exponent),
        .ramp_gain(ramp_gain),
        .ramp_last(ramp_last),
        .load_rsqrt(load && load_space == 3'd3),
        .load_ramp(load && load_space == 3'd4),
        .load_address(load_address[15:0]),
        .load_data(load_data),
        .in_valid(surface_valid),
        .in_ready(surface_ready),
        .in_hit(interpolator_hit),
        .in_surface(surface),
        .in_slope_x(slope_x),
        .in_slope_z(slope_z),
        .in_tag(1'b0),
        .out_valid(pixel_valid),
        .out_ready(pixel_ready),
        .out_color(pixel_color),
        .out_hit(shader_hit),
        .out_tag()
    );
    assign takes[SHADER] = surface_valid && surface_ready;
    assign waits[SHADER] = surface_valid && !surface_ready;
  end else begin : plane
    // ---- Coefficients of a plane
    logic [23:0] sky_color;
    logic [23:0] out_of_range_color;
    logic signed [W-1:0] mean_red;
    logic signed [W-1:0] mean_green;
    logic signed [W-1:0] mean_blue;
    logic signed [W-1:0] swing_red;
    logic signed [W-1:0] swing_green;
    logic signed [W-1:0] swing_blue;
    logic signed [7:0] contrast_exponent;
    logic signed [W-1:0] contrast_gain;
    logic full_from_fitted;
    logic signed [W-1:0] full_from;

    registers_checker #(
        .WIDE(WIDE)
    ) colors (
        .clock(clock),
        .load(load && load_space == 3'd0),
        .load_address(load_address[15:0]),
        .load_data(load_data),
        .sky_color(sky_color),
        .out_of_range_color(out_of_range_color),
        .mean_red(mean_red),
        .mean_green(mean_green),
        .mean_blue(mean_blue),
        .swing_red(swing_red),
        .swing_green(swing_green),
        .swing_blue(swing_blue),
        .contrast_exponent(contrast_exponent),
        .contrast_gain(contrast_gain),
        .full_from_fitted(full_from_fitted),
        .full_from(full_from)
    );

    // ---- Checker
    logic checker_ready;

    assign divider_side = denominator;
    assign view_ready = divider_ready;
    assign entry_ready = checker_ready;
    checkers #(
        .WIDE(WIDE)
    ) checkers (
        .clock(clock),
        .reset(reset),
        .sky_color(sky_color),
        .out_of_range_color(out_of_range_color),
        .mean_red(mean_red),
        .mean_green(mean_green),
        .mean_blue(mean_blue),
        .swing_red(swing_red),
        .swing_green(swing_green),
        .swing_blue(swing_blue),
        .contrast_exponent(contrast_exponent),
        .contrast_gain(contrast_gain),
        .full_from(full_from),
        .full_from_fitted(full_from_fitted),
        .in_valid(entry_valid),
        .in_ready(checker_ready),
        .in_entry(entry),
        .in_ground_x(entry_x),
        .in_ground_z(entry_z),
        .in_denominator(entry_side),
        .in_tag(1'b0),
        .out_valid(pixel_valid),
        .out_ready(pixel_ready),
        .out_color(pixel_color),
        .out_hit(shader_hit),
        .out_tag()
    );
    assign takes[SHADER:STEPPER] = {entry_valid && checker_ready, 2'b00};
    assign waits[SHADER:STEPPER] = {entry_valid && !checker_ready, 2'b00};
    // No height map: no stepper, no interpolation, no memories.
    assign {bound_read, bound_level, bound_column, bound_row} = '0;
    assign {sample_read, sample_column, sample_row, hit_read, hit_column, hit_row} = '0;
    assign {stepper_hit, ground_x, ground_z, steps} = '0;
    assign {interpolator_hit, surface, slope_x, slope_z} = '0;
  end

  assign takes[FRAME] = pixel_valid && pixel_ready;
  assign waits[FRAME] = pixel_valid && !pixel_ready;
endmodule
