// The back end of a height map: three stages in a row, each with a queue at its end, and the bank of what
// they know of the map.
//
//   rays -> terrain_walk -> terrain_surface -> terrain_color -> pixels
//            |       |             |
//          bounds  nodes         nodes            (memories outside)
//
// Never reorders items, never lets two stages share a port of a memory.
module terrain_back #(
    parameter int WIDE = 0,         // words of 64 bits, not 32
    parameter int STRETCH = 0,      // kernels over 3x3 nodes, not 2x2
    parameter int TABLE_LOG2 = 12,  // largest kernel table, as a power of two
    parameter int OUTSTANDING = 8,  // largest memory latency
    localparam int W = WIDE == 1 ? terraline_pkg::WIDE_WIDTH : terraline_pkg::NARROW_WIDTH,
    localparam int CELL = WIDE == 1 ? 26 : 12,  // bits of a cell's index
    localparam int BANK = CELL - 1              // bits of an address in a bank, per axis
) (
    input  logic                     clock,              // rising edge
    input  logic                     reset,              // forgets all items
    // Loading
    input  logic                     load_coefficient,   // take `load_data` at this edge as a coefficient
    input  logic                     load_weight,        // as a weight of the kernel
    input  logic                     load_slope,         // as one of its slopes
    input  logic                     load_rsqrt,         // as a reciprocal square root
    input  logic                     load_ramp,          // as a colour of the ramp
    input  logic        [      16:0] load_address,       // coefficient, or entry of the table
    input  logic        [     W-1:0] load_data,          // word
    // Coefficients of the front end's bank
    input  logic signed [     W-1:0] eye_x,              // the eye, x in cells
    input  logic signed [     W-1:0] eye_z,              // z
    input  logic                     from_eye,           // rays start at the eye
    // Items from the front end
    input  logic                     in_valid,           // an item is there
    output logic                     in_ready,           // it is taken at this edge
    input  logic        [       1:0] in_entry,           // 0 met, 1 sky, 2 out of range
    input  logic signed [     W-1:0] in_ground_x,        // where the ray enters, x
    input  logic signed [     W-1:0] in_ground_z,        // z
    input  logic signed [     W-1:0] in_view_x,          // view vector, x
    input  logic signed [     W-1:0] in_view_y,          // y
    input  logic signed [     W-1:0] in_view_z,          // z
    // Memory of the pyramid's bounds
    output logic                     bound_read,         // an address is there
    output logic        [       4:0] bound_level,        // level
    output logic        [  CELL-1:0] bound_column,       // stored bound, x
    output logic        [  CELL-1:0] bound_row,          // z
    input  logic                     bound_valid,        // the bound is there
    input  logic signed [     W-1:0] bound,              // height units
    // Memory of heights, port of the stepper's samples: four banks by (i & 1, j & 1)
    output logic                     sample_read,        // addresses are there
    output logic        [4*BANK-1:0] sample_column,      // i >> 1 per bank, bank 0 lowest
    output logic        [4*BANK-1:0] sample_row,         // j >> 1 per bank
    input  logic                     sample_data_valid,  // the nodes are there
    input  logic        [   4*W-1:0] sample_data,        // a node per bank
    input  logic        [       3:0] sample_void,        // it has no data
    // The same memory, port of the hits
    output logic                     hit_read,           // addresses are there
    output logic        [4*BANK-1:0] hit_column,         // i >> 1 per bank, bank 0 lowest
    output logic        [4*BANK-1:0] hit_row,            // j >> 1 per bank
    input  logic                     hit_data_valid,     // the nodes are there
    input  logic        [   4*W-1:0] hit_data,           // a node per bank
    input  logic        [       3:0] hit_void,           // it has no data
    // Pixels
    output logic                     pixel_valid,        // a pixel is there
    input  logic                     pixel_ready,        // it is taken at this edge
    output logic        [      23:0] pixel_color,        // sRGB bytes, red in the low byte
    output logic        [       1:0] pixel_hit,          // outcome
    // Probes
    output logic        [       1:0] walk_hit,           // from the stepper: 0 sky, 1 surface, 2 side, 3 out of range
    output logic signed [     W-1:0] walk_x,             // place of the hit, x
    output logic signed [     W-1:0] walk_z,             // z
    output logic        [      25:0] walk_steps,         // index of the sample that hit
    output logic        [       1:0] surface_hit,        // from the interpolator: outcome
    output logic signed [     W-1:0] surface,            // surface height
    output logic signed [     W-1:0] slope_x,            // slope against x, negated
    output logic signed [     W-1:0] slope_z,            // against z
    output logic        [       2:0] probe_valid,        // bits stepper, interpolator, shader: an item is before it
    output logic        [       2:0] probe_ready         // the same: it takes an item at this edge
);
  // ---- Coefficients
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
  ) registers (
      .clock(clock),
      .load(load_coefficient),
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

  // ---- Stages
  logic map_ends;
  logic walk_valid, walk_ready, surface_valid, surface_ready;

  assign map_ends = map_edge == 2'd0;
  terrain_walk #(
      .WIDE(WIDE),
      .STRETCH(STRETCH),
      .TABLE_LOG2(TABLE_LOG2),
      .OUTSTANDING(OUTSTANDING)
  ) walk (
      .clock(clock),
      .reset(reset),
      .load_coefficient(load_coefficient),
      .load_weight(load_weight),
      .load_address(load_address),
      .load_data(load_data),
      .eye_x(eye_x),
      .eye_z(eye_z),
      .from_eye(from_eye),
      .form(form),
      .deformation_shift(deformation_shift),
      .kernel_log2(kernel_log2),
      .map_columns(map_columns),
      .map_rows(map_rows),
      .map_ends(map_ends),
      .void_bits(void_bits),
      .in_valid(in_valid),
      .in_ready(in_ready),
      .in_entry(in_entry),
      .in_ground_x(in_ground_x),
      .in_ground_z(in_ground_z),
      .in_view_x(in_view_x),
      .in_view_y(in_view_y),
      .in_view_z(in_view_z),
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
      .out_valid(walk_valid),
      .out_ready(walk_ready),
      .out_hit(walk_hit),
      .out_ground_x(walk_x),
      .out_ground_z(walk_z),
      .out_steps(walk_steps)
  );
  terrain_surface #(
      .WIDE(WIDE),
      .STRETCH(STRETCH),
      .TABLE_LOG2(TABLE_LOG2),
      .OUTSTANDING(OUTSTANDING)
  ) surface_at_hit (
      .clock(clock),
      .reset(reset),
      .load_weight(load_weight),
      .load_slope(load_slope),
      .load_address(load_address),
      .load_data(load_data),
      .form(form),
      .deformation_shift(deformation_shift),
      .kernel_log2(kernel_log2),
      .map_columns(map_columns),
      .map_rows(map_rows),
      .map_ends(map_ends),
      .void_bits(void_bits),
      .slope_scaled(slope_scaled),
      .slope_scale_x(slope_scale_x),
      .slope_scale_z(slope_scale_z),
      .memory_latency(memory_latency),
      .in_valid(walk_valid),
      .in_ready(walk_ready),
      .in_hit(walk_hit),
      .in_ground_x(walk_x),
      .in_ground_z(walk_z),
      .hit_read(hit_read),
      .hit_column(hit_column),
      .hit_row(hit_row),
      .hit_data_valid(hit_data_valid),
      .hit_data(hit_data),
      .hit_void(hit_void),
      .out_valid(surface_valid),
      .out_ready(surface_ready),
      .out_hit(surface_hit),
      .out_surface(surface),
      .out_slope_x(slope_x),
      .out_slope_z(slope_z)
  );
  terrain_color #(
      .WIDE(WIDE)
  ) color (
      .clock(clock),
      .reset(reset),
      .load_coefficient(load_coefficient),
      .load_rsqrt(load_rsqrt),
      .load_ramp(load_ramp),
      .load_address(load_address[15:0]),
      .load_data(load_data),
      .in_valid(surface_valid),
      .in_ready(surface_ready),
      .in_hit(surface_hit),
      .in_surface(surface),
      .in_slope_x(slope_x),
      .in_slope_z(slope_z),
      .out_valid(pixel_valid),
      .out_ready(pixel_ready),
      .out_color(pixel_color),
      .out_hit(pixel_hit)
  );

  assign probe_valid = {surface_valid, walk_valid, in_valid};
  assign probe_ready = {surface_ready, walk_ready, in_ready};
endmodule
