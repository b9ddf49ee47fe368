// The projector: view vector and denominator of every pixel of the scan (equations 5, 6, 8;
// thesis 2.15, 2.36, 2.37), one pixel per cycle, by additions alone.
module projector #(
    parameter int WIDE = 0  // words of 64 bits, not 32
) (
    input  logic                                    clock,
    input  logic                                    reset,                  // forgets all items
    input  logic                                    start,                  // go to the first pixel
    // The scan
    input  logic                                    running,                // there is a pixel
    input  logic                                    last_column,            // it ends its line
    output logic                                    step,                   // it is taken at this edge
    // Coefficients
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] view_x_start,           // at line 0, column 0
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] view_x_per_line,        // increment per line
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] view_x_per_column,      // increment per column
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] view_y_start,           // the same of view_y
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] view_y_per_line,        // increment per line
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] view_y_per_column,      // increment per column
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] view_z_start,           // the same of view_z
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] view_z_per_line,        // increment per line
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] view_z_per_column,      // increment per column
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] denominator_start,      // of the denominator
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] denominator_per_line,   // increment per line
    input  logic signed [(WIDE == 1 ? 64 : 32)-1:0] denominator_per_column, // increment per column
    // Items to the next unit
    output logic                                    out_valid,              // an item is there
    input  logic                                    out_ready,              // it is taken
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] out_view_x,             // view vector, x
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] out_view_y,             // y
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] out_view_z,             // z
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] out_denominator         // positive towards the plane
);
  localparam int W = WIDE == 1 ? terraline_pkg::WIDE_WIDTH : terraline_pkg::NARROW_WIDTH;
  localparam int DEPTH = terraline_pkg::PROJECTOR_DEPTH;

  logic room;
  logic signed [W-1:0] view_x, view_y, view_z, denominator;

  assign step = running && room;

  accumulator #(
      .W(W)
  ) accumulator_x (
      .clock(clock),
      .start(start),
      .step(step),
      .last_column(last_column),
      .first(view_x_start),
      .per_line(view_x_per_line),
      .per_column(view_x_per_column),
      .value(view_x)
  );
  accumulator #(
      .W(W)
  ) accumulator_y (
      .clock(clock),
      .start(start),
      .step(step),
      .last_column(last_column),
      .first(view_y_start),
      .per_line(view_y_per_line),
      .per_column(view_y_per_column),
      .value(view_y)
  );
  accumulator #(
      .W(W)
  ) accumulator_z (
      .clock(clock),
      .start(start),
      .step(step),
      .last_column(last_column),
      .first(view_z_start),
      .per_line(view_z_per_line),
      .per_column(view_z_per_column),
      .value(view_z)
  );
  accumulator #(
      .W(W)
  ) accumulator_denominator (
      .clock(clock),
      .start(start),
      .step(step),
      .last_column(last_column),
      .first(denominator_start),
      .per_line(denominator_per_line),
      .per_column(denominator_per_column),
      .value(denominator)
  );

  credit #(
      .COUNT(2)
  ) credits (
      .clock(clock),
      .reset(reset),
      .depth(2'(DEPTH)),
      .enter(step),
      .leave(out_valid && out_ready),
      .room(room)
  );
  queue #(
      .WIDTH(4 * W),
      .DEPTH(DEPTH)
  ) results (
      .clock(clock),
      .reset(reset),
      .put(step),
      .in_item({view_x, view_y, view_z, denominator}),
      .out_valid(out_valid),
      .out_ready(out_ready),
      .out_item({out_view_x, out_view_y, out_view_z, out_denominator})
  );
endmodule
