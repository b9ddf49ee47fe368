// The second stage of a height map: surface height and slopes at each hit. `surface_stage` takes the
// items and hands them on, an interpolation does the rest.
//
// Never tells hits from other items: those without a hit go the same way, and nobody looks at their
// surface.
module terrain_surface #(
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
    input  logic                     load_weight,        // take `load_data` at this edge as a weight of the kernel
    input  logic                     load_slope,         // as one of its slopes
    input  logic        [      16:0] load_address,       // entry of the table
    input  logic        [     W-1:0] load_data,          // word
    // Coefficients
    input  logic        [       1:0] form,               // weights of 2×2 nodes: 0 plain, 1 toward the hat, 2 the hat
    input  logic        [       5:0] deformation_shift,  // of the kernel's difference to the hat
    input  logic        [       4:0] kernel_log2,        // entries of the kernel tables a cell, as a power of two
    input  logic        [  CELL-1:0] map_columns,        // nodes in x
    input  logic        [  CELL-1:0] map_rows,           // nodes in z
    input  logic                     map_ends,           // the map ends at its edge, else its edge goes on
    input  logic                     void_bits,          // nodes may have no data
    input  logic                     slope_scaled,       // slopes have factors
    input  logic signed [     W-1:0] slope_scale_x,      // factor on a slope, x: height unit over cell
    input  logic signed [     W-1:0] slope_scale_z,      // z
    input  logic        [       6:0] memory_latency,     // M
    // Items from the stepper
    input  logic                     in_valid,           // an item is there
    output logic                     in_ready,           // it is taken at this edge
    input  logic        [       1:0] in_hit,             // 0 sky, 1 surface, 2 side, 3 out of range
    input  logic signed [     W-1:0] in_ground_x,        // place of the hit, x
    input  logic signed [     W-1:0] in_ground_z,        // z
    // Memory of heights, four banks by (i & 1, j & 1)
    output logic                     hit_read,           // addresses are there
    output logic        [4*BANK-1:0] hit_column,         // i >> 1 per bank, bank 0 lowest
    output logic        [4*BANK-1:0] hit_row,            // j >> 1 per bank
    input  logic                     hit_data_valid,     // the nodes are there
    input  logic        [   4*W-1:0] hit_data,           // a node per bank
    input  logic        [       3:0] hit_void,           // it has no data
    // Items to the next stage
    output logic                     out_valid,          // an item is there
    input  logic                     out_ready,          // it is taken at this edge
    output logic        [       1:0] out_hit,            // outcome, as taken
    output logic signed [     W-1:0] out_surface,        // surface height
    output logic signed [     W-1:0] out_slope_x,        // slope against x, negated
    output logic signed [     W-1:0] out_slope_z         // against z
);
  logic place_valid, place_first, place_last, answer_valid;
  logic [W-1:0] place_x, place_z, answer_surface, answer_slope_x, answer_slope_z;
  logic [1:0] place_tag, answer_tag;

  surface_stage #(
      .WIDE(WIDE),
      .OUTSTANDING(OUTSTANDING)
  ) surface_stage (
      .clock(clock),
      .reset(reset),
      .memory_latency(memory_latency),
      .in_valid(in_valid),
      .in_ready(in_ready),
      .in_hit(in_hit),
      .in_ground_x(in_ground_x),
      .in_ground_z(in_ground_z),
      .request_valid(place_valid),
      .request_first(place_first),
      .request_last(place_last),
      .request_x(place_x),
      .request_z(place_z),
      .request_tag(place_tag),
      .answer_valid(answer_valid),
      .answer_surface(answer_surface),
      .answer_slope_x(answer_slope_x),
      .answer_slope_z(answer_slope_z),
      .answer_tag(answer_tag),
      .out_valid(out_valid),
      .out_ready(out_ready),
      .out_hit(out_hit),
      .out_surface(out_surface),
      .out_slope_x(out_slope_x),
      .out_slope_z(out_slope_z)
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
      .map_ends(map_ends),
      .void_bits(void_bits),
      .slope_scaled(slope_scaled),
      .slope_scale_x(slope_scale_x),
      .slope_scale_z(slope_scale_z),
      .load_weight(load_weight),
      .load_slope(load_slope),
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
      .answer_valid(answer_valid),
      .answer_exists(),
      .answer_surface(answer_surface),
      .answer_slope_x(answer_slope_x),
      .answer_slope_z(answer_slope_z),
      .answer_tag(answer_tag)
  );
endmodule
