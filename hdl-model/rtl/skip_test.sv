// A skip test: whether a jump from one place to another passes above a bound of the pyramid, so that no
// sample in between can hit (equation 21).
//
// The bound's address belongs to the cycle in which the jump is tried; whether there is a bound at all is
// kept until it comes.
module skip_test #(
    parameter int W    = 32,  // bits of a word
    parameter int CELL = 12   // bits of a cell's index
) (
    input  logic                   clock,
    // Coefficients
    input  logic        [CELL-1:0] map_columns,   // nodes in x
    input  logic        [CELL-1:0] map_rows,      // nodes in z
    input  logic                   map_ends,      // the map ends at its edge
    // What the stepper does in this cycle
    input  logic                   tries,         // asks for the bound
    // The jump
    input  logic        [     4:0] level,         // its level
    input  logic signed [CELL-1:0] i,             // cell where it begins, x
    input  logic signed [CELL-1:0] j,             // z
    input  logic signed [   W-1:0] place_y,       // height where it begins
    input  logic signed [   W-1:0] ahead_y,       // height where it ends
    // The bound
    output logic        [CELL-1:0] bound_column,  // stored bound, x
    output logic        [CELL-1:0] bound_row,     // z
    input  logic signed [   W-1:0] bound,         // height units
    output logic                   none,          // there is no surface to be bounded
    output logic                   clear          // no sample of the jump hits
);
  logic none_here;

  pyramid #(.CELL(CELL)) pyramid (
      .map_columns(map_columns), .map_rows(map_rows), .map_ends(map_ends), .level(level),
      .i(i), .j(j), .column(bound_column), .row(bound_row), .none(none_here));
  always_ff @(posedge clock) if (tries) none <= none_here;
  assign clear = none || (place_y >= bound && ahead_y >= bound);
endmodule
