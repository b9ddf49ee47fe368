// The processor: raster scan, projector and divider, and behind them the back end of a height map
// (TERRAIN = 1) or of a plane (TERRAIN = 0). Pixels come out in scan order.
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
  localparam int PROJECTOR = 0, DIVIDER = 1, STEPPER = 2, SHADER = 4, FRAME = 5;

  // ---- Loading: which part a word is for
  logic load_coefficient, load_weight, load_slope, load_rsqrt, load_ramp;

  assign load_coefficient = load && load_space == 3'd0;
  assign load_weight = load && load_space == 3'd1;
  assign load_slope = load && load_space == 3'd2;
  assign load_rsqrt = load && load_space == 3'd3;
  assign load_ramp = load && load_space == 3'd4;

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
      .load(load_coefficient),
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

  // ---- Back end
  if (TERRAIN == 1) begin : terrain
    logic ray_valid, ray_ready;
    logic [W-1:0] ray_x, ray_y, ray_z;
    logic [2:0] valid, ready;

    assign divider_side = {view_x, view_y, view_z};
    assign ray_valid = from_eye ? view_valid : entry_valid;
    assign {ray_x, ray_y, ray_z} = from_eye ? divider_side : entry_side;
    assign entry_ready = ray_ready && !from_eye;
    assign view_ready = from_eye ? ray_ready : divider_ready;
    assign takes[SHADER:STEPPER] = valid & ready;
    assign waits[SHADER:STEPPER] = valid & ~ready;
    terrain_back #(
        .WIDE(WIDE),
        .STRETCH(STRETCH),
        .TABLE_LOG2(TABLE_LOG2),
        .OUTSTANDING(OUTSTANDING)
    ) back (
        .clock(clock),
        .reset(reset),
        .load_coefficient(load_coefficient),
        .load_weight(load_weight),
        .load_slope(load_slope),
        .load_rsqrt(load_rsqrt),
        .load_ramp(load_ramp),
        .load_address(load_address),
        .load_data(load_data),
        .eye_x(eye_x),
        .eye_z(eye_z),
        .from_eye(from_eye),
        .in_valid(ray_valid),
        .in_ready(ray_ready),
        .in_entry(entry),
        .in_ground_x(entry_x),
        .in_ground_z(entry_z),
        .in_view_x(ray_x),
        .in_view_y(ray_y),
        .in_view_z(ray_z),
        .bound_read(bound_read),
        .bound_level(bound_level),
        .bound_column(bound_column),
        .bound_row(bound_row),
        .bound_valid(bound_valid),
        .bound(bound),
        .sample_read(sample_read),
        .sample_column(sample_column),
        .sample_row(sample_row),
        .sample_data_valid(sample_data_valid),
        .sample_data(sample_data),
        .sample_void(sample_void),
        .hit_read(hit_read),
        .hit_column(hit_column),
        .hit_row(hit_row),
        .hit_data_valid(hit_data_valid),
        .hit_data(hit_data),
        .hit_void(hit_void),
        .pixel_valid(pixel_valid),
        .pixel_ready(pixel_ready),
        .pixel_color(pixel_color),
        .pixel_hit(shader_hit),
        .walk_hit(stepper_hit),
        .walk_x(ground_x),
        .walk_z(ground_z),
        .walk_steps(steps),
        .surface_hit(interpolator_hit),
        .surface(surface),
        .slope_x(slope_x),
        .slope_z(slope_z),
        .probe_valid(valid),
        .probe_ready(ready)
    );
  end else begin : plane
    assign divider_side = denominator;
    assign view_ready = divider_ready;
    plane_back #(
        .WIDE(WIDE)
    ) back (
        .clock(clock),
        .reset(reset),
        .load_coefficient(load_coefficient),
        .load_address(load_address[15:0]),
        .load_data(load_data),
        .in_valid(entry_valid),
        .in_ready(entry_ready),
        .in_entry(entry),
        .in_ground_x(entry_x),
        .in_ground_z(entry_z),
        .in_denominator(entry_side),
        .out_valid(pixel_valid),
        .out_ready(pixel_ready),
        .out_color(pixel_color),
        .out_hit(shader_hit)
    );
    // The checker stands in the shader's place. No height map: no stepper, no interpolation, no memories.
    assign takes[SHADER:STEPPER] = {entry_valid && entry_ready, 2'b00};
    assign waits[SHADER:STEPPER] = {entry_valid && !entry_ready, 2'b00};
    assign {bound_read, bound_level, bound_column, bound_row} = '0;
    assign {sample_read, sample_column, sample_row, hit_read, hit_column, hit_row} = '0;
    assign {stepper_hit, ground_x, ground_z, steps} = '0;
    assign {interpolator_hit, surface, slope_x, slope_z} = '0;
  end

  assign takes[FRAME] = pixel_valid && pixel_ready;
  assign waits[FRAME] = pixel_valid && !pixel_ready;
endmodule
