// The address unit of the height memory: which words of the four banks hold the 2×2 nodes from
// (column, row) on, and whether the map covers a cell. No cycles; the banks are outside.
//
// A node (i, j) is in bank (i & 1) + 2·(j & 1) at the address (i >> 1, j >> 1), so that any 2×2
// nodes are read at once. Never reads outside the map: indices are clamped. Maps that repeat
// (`wrap`) are not built.
module height_memory #(
    parameter int CELL = 12  // bits of a cell index
) (
    input  logic [      CELL-1:0] map_columns,  // nodes in x, 1 to 2^(CELL-1)
    input  logic [      CELL-1:0] map_rows,     // nodes in z
    input  logic                  map_ends,     // the map ends at its edge, else its edge goes on
    input  logic [      CELL-1:0] cell_x,       // cell of the place, signed
    input  logic [      CELL-1:0] cell_z,
    input  logic [      CELL+1:0] column,       // of the first node, signed
    input  logic [      CELL+1:0] row,
    output logic                  on_map,       // the map covers the cell
    output logic [4*(CELL-1)-1:0] read_column,  // address in the banks: bank 0 in the lowest bits
    output logic [4*(CELL-1)-1:0] read_row,
    output logic [           3:0] odd           // south, north, east, west node is in an odd bank
);
  logic [CELL-2:0] even_column, odd_column, even_row, odd_row;

  edge_address #(
      .CELL(CELL)
  ) along_x (
      .index(column),
      .size(map_columns),
      .even(even_column),
      .odd(odd_column),
      .lower_odd(odd[0]),
      .upper_odd(odd[1])
  );
  edge_address #(
      .CELL(CELL)
  ) along_z (
      .index(row),
      .size(map_rows),
      .even(even_row),
      .odd(odd_row),
      .lower_odd(odd[2]),
      .upper_odd(odd[3])
  );

  assign read_column = {odd_column, even_column, odd_column, even_column};
  assign read_row    = {odd_row, odd_row, even_row, even_row};
  // Negative cells are large without their sign.
  assign on_map = !map_ends
      || (cell_x < map_columns - CELL'(1) && cell_z < map_rows - CELL'(1));
endmodule
