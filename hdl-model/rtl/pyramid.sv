// Addresses of the skip pyramid: which bound holds for a ray in a cell, and whether there is one
// (docs/units/pyramid.md). The bounds themselves are in a memory outside.
module pyramid #(
    parameter int CELL = 12  // bits of a cell's index
) (
    // Coefficients
    input  logic        [CELL-1:0] map_columns,  // nodes in x
    input  logic        [CELL-1:0] map_rows,     // nodes in z
    input  logic                   map_ends,     // the map ends at its edge, else its edge goes on
    // The ray
    input  logic        [     4:0] level,        // m: blocks of 2^m cells
    input  logic signed [CELL-1:0] i,            // cell, x
    input  logic signed [CELL-1:0] j,            // cell, z
    // Its bound
    output logic        [CELL-1:0] column,       // stored bound, x
    output logic        [CELL-1:0] row,          // stored bound, z
    output logic                   none          // there is none: nothing is in reach
);
  logic none_x, none_z;

  pyramid_axis #(
      .CELL(CELL)
  ) axis_x (
      .nodes(map_columns),
      .ends(map_ends),
      .level(level),
      .cell_index(i),
      .stored(column),
      .none(none_x)
  );
  pyramid_axis #(
      .CELL(CELL)
  ) axis_z (
      .nodes(map_rows),
      .ends(map_ends),
      .level(level),
      .cell_index(j),
      .stored(row),
      .none(none_z)
  );

  assign none = none_x || none_z;
endmodule
