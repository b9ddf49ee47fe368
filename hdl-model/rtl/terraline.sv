// The processor: a front end that makes rays of pixels, and behind it the back end of a height map
// (TERRAIN = 1) or of a plane (TERRAIN = 0). Pixels come out in scan order.
//
//   front_end: raster -> projector -> divider
//     -> terrain_back: stepper -> interpolator -> shader -> pixels
//     -> plane_back:   checkers -> pixels
//
// Coefficients and tables are loaded, then `start` is given; the cycle after it is cycle 0. Each part
// keeps its coefficients in a bank of its own. Heights and bounds of the pyramid lie in memories outside,
// which answer in order, M cycles after the address. The ports from `takes` on are probes: they say what
// passes between the units, and drive nothing in a machine.
//
// Never reorders pixels, never multiplies, never divides.
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
    input  logic                clock,             // rising edge
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
    output logic [         1:0] stepper_hit,       // from the stepper: 0 sky, 1 surface, 2 side, 3 out of range
    output logic [       W-1:0] ground_x,          // place of the hit, x
    output logic [       W-1:0] ground_z,          // z
    output logic [        25:0] steps,             // index of the sample that hit
    output logic [         1:0] interpolator_hit,  // from the interpolator: outcome
    output logic [       W-1:0] surface,           // surface height
    output logic [       W-1:0] slope_x,           // slope against x, negated
    output logic [       W-1:0] slope_z,           // against z
    output logic [         1:0] shader_hit         // from the shader: outcome
);
  // ---- Loading: which part a word is for
  logic load_coefficient, load_weight, load_slope, load_rsqrt, load_ramp;

  assign load_coefficient = load && load_space == 3'd0;
  assign load_weight = load && load_space == 3'd1;
  assign load_slope = load && load_space == 3'd2;
  assign load_rsqrt = load && load_space == 3'd3;
  assign load_ramp = load && load_space == 3'd4;

  // ---- Front end
  localparam int SIDE = TERRAIN == 1 ? 3 * W : W;
  logic [W-1:0] eye_x, eye_z;
  logic from_eye, ray_valid, ray_ready;
  logic [SIDE-1:0] ray_side;
  logic [5:0] valid, ready;  // per unit: an item is there, it takes one

  front_end #(
      .WIDE(WIDE),
      .TERRAIN(TERRAIN),
      .SERIAL(SERIAL)
  ) front (
      .clock(clock),
      .reset(reset),
      .start(start),
      .load_coefficient(load_coefficient),
      .load_address(load_address[15:0]),
      .load_data(load_data),
      .eye_x(eye_x),
      .eye_z(eye_z),
      .from_eye(from_eye),
      .out_valid(ray_valid),
      .out_ready(ray_ready),
      .out_entry(entry),
      .out_ground_x(entry_x),
      .out_ground_z(entry_z),
      .out_side(ray_side),
      .view_x(view_x),
      .view_y(view_y),
      .view_z(view_z),
      .denominator(denominator),
      .probe_valid(valid[1:0]),
      .probe_ready(ready[1:0])
  );

  // ---- Back end
  if (TERRAIN == 1) begin : terrain
    logic [W-1:0] ray_x, ray_y, ray_z;

    assign {ray_x, ray_y, ray_z} = ray_side;
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
        .probe_valid(valid[4:2]),
        .probe_ready(ready[4:2])
    );
  end else begin : plane
    plane_back #(
        .WIDE(WIDE)
    ) back (
        .clock(clock),
        .reset(reset),
        .load_coefficient(load_coefficient),
        .load_address(load_address[15:0]),
        .load_data(load_data),
        .in_valid(ray_valid),
        .in_ready(ray_ready),
        .in_entry(entry),
        .in_ground_x(entry_x),
        .in_ground_z(entry_z),
        .in_denominator(ray_side),
        .out_valid(pixel_valid),
        .out_ready(pixel_ready),
        .out_color(pixel_color),
        .out_hit(shader_hit)
    );
    // The checker stands in the shader's place. No height map: no stepper, no interpolation, no memories.
    assign valid[4:2] = {ray_valid, 2'b00};
    assign ready[4:2] = {ray_ready, 2'b00};
    assign {bound_read, bound_level, bound_column, bound_row} = '0;
    assign {sample_read, sample_column, sample_row, hit_read, hit_column, hit_row} = '0;
    assign {stepper_hit, ground_x, ground_z, steps} = '0;
    assign {interpolator_hit, surface, slope_x, slope_z} = '0;
  end

  // ---- Probes; the last unit is the frame, which takes the pixels
  assign valid[5] = pixel_valid;
  assign ready[5] = pixel_ready;
  assign takes = valid & ready;
  assign waits = valid & ~ready;
endmodule
