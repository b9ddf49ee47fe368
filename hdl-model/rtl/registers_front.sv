// Generated from the register table (src/setup/table.rs) and the lists of coefficients
// (src/unit/coefficient.rs) and cycles (src/unit) by `cargo run -p terraline-hdl -- generate`; a
// test compares.

// The coefficients of raster scan, projector and divider. Loaded before `start`, one per cycle.
//
// Never reset, never changed within a frame.
module registers_front #(
    parameter int WIDE = 0  // words of 64 bits, not 32
) (
    input logic clock,
    input logic load,  // take `load_data` at this edge
    input logic [15:0] load_address,  // terraline_pkg::ADDRESS_..., perhaps of another bank
    input logic [(WIDE == 1 ? 64 : 32)-1:0] load_data,  // in the low bits
    output logic [15:0] columns,  // pixels across
    output logic [15:0] lines,  // scan lines
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] view_x_start,  // view_x at line 0, column 0
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] view_x_per_line,  // its increment per line
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] view_x_per_column,  // its increment per column
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] view_y_start,  // view_y at line 0, column 0
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] view_y_per_line,  // its increment per line
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] view_y_per_column,  // its increment per column
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] view_z_start,  // view_z at line 0, column 0
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] view_z_per_line,  // its increment per line
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] view_z_per_column,  // its increment per column
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] denominator_start,  // denominator at line 0, column 0
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] denominator_per_line,  // its increment per line
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] denominator_per_column,  // its increment per column
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] eye_x,  // the eye, x: cells, or squares of a plane
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] eye_z,  // the eye, z
    output logic signed [7:0] ratio_shift_x,  // places to shift the numerator left (right if negative) before the ratio, x
    output logic [5:0] ratio_bits_x,  // quotient bits, x: the quotient is in range from -2^(bits-1) to 2^(bits-1)-1
    output logic from_eye  // 1 where rays start at the eye, not at the entry
);
  always_ff @(posedge clock) begin
    if (load) begin
      case (load_address)
        16'(terraline_pkg::ADDRESS_COLUMNS): columns <= load_data[15:0];
        16'(terraline_pkg::ADDRESS_LINES): lines <= load_data[15:0];
        16'(terraline_pkg::ADDRESS_VIEW_X_START): view_x_start <= load_data;
        16'(terraline_pkg::ADDRESS_VIEW_X_PER_LINE): view_x_per_line <= load_data;
        16'(terraline_pkg::ADDRESS_VIEW_X_PER_COLUMN): view_x_per_column <= load_data;
        16'(terraline_pkg::ADDRESS_VIEW_Y_START): view_y_start <= load_data;
        16'(terraline_pkg::ADDRESS_VIEW_Y_PER_LINE): view_y_per_line <= load_data;
        16'(terraline_pkg::ADDRESS_VIEW_Y_PER_COLUMN): view_y_per_column <= load_data;
        16'(terraline_pkg::ADDRESS_VIEW_Z_START): view_z_start <= load_data;
        16'(terraline_pkg::ADDRESS_VIEW_Z_PER_LINE): view_z_per_line <= load_data;
        16'(terraline_pkg::ADDRESS_VIEW_Z_PER_COLUMN): view_z_per_column <= load_data;
        16'(terraline_pkg::ADDRESS_DENOMINATOR_START): denominator_start <= load_data;
        16'(terraline_pkg::ADDRESS_DENOMINATOR_PER_LINE): denominator_per_line <= load_data;
        16'(terraline_pkg::ADDRESS_DENOMINATOR_PER_COLUMN): denominator_per_column <= load_data;
        16'(terraline_pkg::ADDRESS_EYE_X): eye_x <= load_data;
        16'(terraline_pkg::ADDRESS_EYE_Z): eye_z <= load_data;
        16'(terraline_pkg::ADDRESS_RATIO_SHIFT_X): ratio_shift_x <= load_data[7:0];
        16'(terraline_pkg::ADDRESS_RATIO_BITS_X): ratio_bits_x <= load_data[5:0];
        16'(terraline_pkg::ADDRESS_FROM_EYE): from_eye <= load_data[0];
        default: ;
      endcase
    end
  end
endmodule
