// The first stage of a height map: the stepper, with the bank of its coefficients and an interpolation
// of its own, which gives it the surface under each sample.
//
// Stepper and interpolation speak without waiting: a sample that is asked for has its answer a fixed
// number of cycles behind its nodes (docs/units/stepper.md).
//
// Never asks the interpolation for slopes.
module terrain_walk #(
    parameter int WIDE = 0,         // words of 64 bits, not 32
    parameter int STRETCH = 0,      // kernels over 3x3 nodes, not 2x2
    parameter int TABLE_LOG2 = 12,  // largest kernel table, as a power of two
    parameter int OUTSTANDING = 8,  // largest memory latency
    localparam int W = WIDE == 1 ? terraline_pkg::WIDE_WIDTH : terraline_pkg::NARROW_WIDTH,
    localparam int CELL = WIDE == 1 ? 26 : 12,  // bits of a cell's index
    localparam int BANK = CELL - 1              // bits of an address in a bank, per axis
) (
    input  logic                     clock,              // rising edge
    input  logic                     reset,              // forgets all rays
    // Loading
    input  logic                     load_coefficient,   // take `load_data` at this edge as a coefficient
    input  logic                     load_weight,        // as a weight of the kernel
    input  logic        [      16:0] load_address,       // coefficient, or entry of the table
    input  logic        [     W-1:0] load_data,          // word
    // Coefficients of other banks
    input  logic signed [     W-1:0] eye_x,              // the eye, x in cells
    input  logic signed [     W-1:0] eye_z,              // z
    input  logic                     from_eye,           // rays start at the eye
    input  logic        [       1:0] form,               // weights of 2×2 nodes: 0 plain, 1 toward the hat, 2 the hat
    input  logic        [       5:0] deformation_shift,  // of the kernel's difference to the hat
    input  logic        [       4:0] kernel_log2,        // entries of the kernel tables a cell, as a power of two
    input  logic        [  CELL-1:0] map_columns,        // nodes in x
    input  logic        [  CELL-1:0] map_rows,           // nodes in z
    input  logic                     map_ends,           // the map ends at its edge, else its edge goes on
    input  logic                     void_bits,          // nodes may have no data
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
    // Memory of heights, four banks by (i & 1, j & 1)
    output logic                     sample_read,        // addresses are there
    output logic        [4*BANK-1:0] sample_column,      // i >> 1 per bank, bank 0 lowest
    output logic        [4*BANK-1:0] sample_row,         // j >> 1 per bank
    input  logic                     sample_data_valid,  // the nodes are there
    input  logic        [   4*W-1:0] sample_data,        // a node per bank
    input  logic        [       3:0] sample_void,        // it has no data
    // Items to the next stage
    output logic                     out_valid,          // an item is there
    input  logic                     out_ready,          // it is taken at this edge
    output logic        [       1:0] out_hit,            // 0 sky, 1 surface, 2 side, 3 out of range
    output logic signed [     W-1:0] out_ground_x,       // place of the hit, x
    output logic signed [     W-1:0] out_ground_z,       // z
    output logic        [      25:0] out_steps           // index of the sample that hit
);
  // ---- Coefficients
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
  ) registers (
      .clock(clock),
      .load(load_coefficient),
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

  // ---- Samples, and the surface under them
  logic sample_valid, sample_first, sample_last, answer_valid, answer_exists;
  logic [W-1:0] sample_x, sample_z, answer_surface;
  logic [2:0] sample_tag, answer_tag;

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
      .map_ends(map_ends),
      .sides(sides),
      .void_bits(void_bits),
      .in_valid(in_valid),
      .in_ready(in_ready),
      .in_entry(in_entry),
      .in_view_x(in_view_x),
      .in_view_y(in_view_y),
      .in_view_z(in_view_z),
      .in_ground_x(in_ground_x),
      .in_ground_z(in_ground_z),
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
      .answer_valid(answer_valid),
      .answer_exists(answer_exists),
      .answer_surface(answer_surface),
      .answer_tag(answer_tag),
      .out_valid(out_valid),
      .out_ready(out_ready),
      .out_hit(out_hit),
      .out_ground_x(out_ground_x),
      .out_ground_z(out_ground_z),
      .out_steps(out_steps)
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
      .map_ends(map_ends),
      .void_bits(void_bits),
      .slope_scaled(1'b0),
      .slope_scale_x(W'(0)),
      .slope_scale_z(W'(0)),
      .load_weight(load_weight),
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
      .answer_valid(answer_valid),
      .answer_exists(answer_exists),
      .answer_surface(answer_surface),
      .answer_slope_x(),
      .answer_slope_z(),
      .answer_tag(answer_tag)
  );
endmodule
