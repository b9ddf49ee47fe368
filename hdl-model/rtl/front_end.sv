// The front end: raster scan, projector, divider, and the bank of their coefficients. Pixels become
// rays, in scan order, with the place where each enters the slab of a height map or meets a plane.
//
// Rays from an eye within the slab have no such place: they pass the divider by. With an item goes what
// its back end needs besides: the view vector for a height map, the denominator for a plane.
//
// Never reorders pixels, never drops one: what meets nothing goes on as sky.
module front_end #(
    parameter int WIDE = 0,     // words of 64 bits, not 32
    parameter int TERRAIN = 1,  // a height map is behind it, not a plane
    parameter int SERIAL = 0,   // one stage for all quotient bits of the divider
    localparam int W = WIDE == 1 ? terraline_pkg::WIDE_WIDTH : terraline_pkg::NARROW_WIDTH,
    localparam int SIDE = TERRAIN == 1 ? 3 * W : W  // bits that go along with an item
) (
    input  logic                   clock,             // rising edge
    input  logic                   reset,             // no frame is drawn
    input  logic                   start,             // a frame begins in the next cycle
    // Loading
    input  logic                   load_coefficient,  // take `load_data` at this edge
    input  logic        [    15:0] load_address,      // coefficient
    input  logic        [   W-1:0] load_data,         // word
    // Coefficients that the back end of a height map needs as well
    output logic signed [   W-1:0] eye_x,             // the eye, x in cells
    output logic signed [   W-1:0] eye_z,             // z
    output logic                   from_eye,          // rays start at the eye
    // Items to the back end
    output logic                   out_valid,         // an item is there
    input  logic                   out_ready,         // it is taken at this edge
    output logic        [     1:0] out_entry,         // 0 met, 1 sky, 2 out of range
    output logic signed [   W-1:0] out_ground_x,      // where the ray enters, or meets the plane, x
    output logic signed [   W-1:0] out_ground_z,      // z
    output logic        [SIDE-1:0] out_side,          // view vector x, y, z, the last lowest; denominator
    // Probes
    output logic signed [   W-1:0] view_x,            // from the projector: view vector, x
    output logic signed [   W-1:0] view_y,            // y
    output logic signed [   W-1:0] view_z,            // z
    output logic signed [   W-1:0] denominator,       // denominator
    output logic        [     1:0] probe_valid,       // bits projector, divider: an item is before it
    output logic        [     1:0] probe_ready        // the same: it takes an item at this edge
);
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
  logic signed [7:0] ratio_shift_x;
  logic [5:0] ratio_bits_x;

  registers_front #(
      .WIDE(WIDE)
  ) registers (
      .clock(clock),
      .load(load_coefficient),
      .load_address(load_address),
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

  // ---- Divider
  logic divider_valid, divider_ready, entry_valid, entry_ready;
  logic [SIDE-1:0] side, entry_side;

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
      .in_side(side),
      .out_valid(entry_valid),
      .out_ready(entry_ready),
      .out_entry(out_entry),
      .out_ground_x(out_ground_x),
      .out_ground_z(out_ground_z),
      .out_side(entry_side)
  );

  if (TERRAIN == 1) begin : terrain
    assign side = {view_x, view_y, view_z};
    assign out_valid = from_eye ? view_valid : entry_valid;
    assign out_side = from_eye ? side : entry_side;
    assign entry_ready = out_ready && !from_eye;
    assign view_ready = from_eye ? out_ready : divider_ready;
  end else begin : plane
    assign side = denominator;
    assign out_valid = entry_valid;
    assign out_side = entry_side;
    assign entry_ready = out_ready;
    assign view_ready = divider_ready;
  end

  // The scan gives an item while it runs; a step takes it.
  assign probe_valid = {divider_valid, running};
  assign probe_ready = {divider_ready, step};
endmodule
