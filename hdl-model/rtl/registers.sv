// Generated from the register table (src/setup/table.rs) and the lists of coefficients
// (src/unit/coefficient.rs) and cycles (src/unit) by `cargo run -p terraline-hdl -- generate`; a
// test compares.

// The coefficients of a frame. Loaded before `start`, one per cycle; they do not change within a
// frame.
module registers #(
    parameter int WIDE = 0  // words of 64 bits, not 32
) (
    input logic clock,
    input logic load,  // take `load_data` at this edge
    input logic [15:0] load_address,  // terraline_pkg::ADDRESS_...
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
    output logic from_eye,  // 1 where rays start at the eye, not at the entry
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] eye_y,  // the eye, y in height units
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] highest,  // the highest node: y of an entry
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] base,  // base of the block under the map
    output logic [2:0] fineness,  // k: steps are 2^-k-1 to 2^-k cells
    output logic [25:0] last,  // index of the last sample
    output logic bisection_fixed,  // 1 where every hit takes bisection_cap steps
    output logic signed [7:0] bisection_bias,  // bisection steps are bias minus leading one
    output logic [5:0] bisection_cap,  // and at most this many
    output logic skipping,  // 1 where the pyramid is fitted
    output logic [4:0] pyramid_top,  // highest level of the pyramid
    output logic beyond_sky,  // 1 where an entry out of range is sky, else it stays out of range
    output logic [(WIDE == 1 ? 26 : 12)-1:0] map_columns,  // nodes of the map in x
    output logic [(WIDE == 1 ? 26 : 12)-1:0] map_rows,  // nodes of the map in z
    output logic [1:0] map_edge,  // beyond the edge: 0 the map ends, 1 its edge nodes go on, 2 it repeats
    output logic sides,  // 1 where the map has sides, drawn down to the base
    output logic void_bits,  // 1 where nodes may have no data
    output logic [1:0] form,  // weights: 0 the kernel's, 1 toward the hat's, 2 the hat's, 3 over 3x3 nodes
    output logic [5:0] deformation_shift,  // places that the difference to the hat is shifted right
    output logic [4:0] kernel_log2,  // the kernel tables have 2^log2 entries a cell, and one
    output logic slope_scaled,  // 1 where slopes have factors
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] slope_scale_x,  // factor on a slope, x: height unit over cell
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] slope_scale_z,  // the same, z
    output logic [6:0] memory_latency,  // M: cycles from address to data
    output logic [23:0] sky_color,  // colour where nothing is met
    output logic [23:0] out_of_range_color,  // colour out of range
    output logic [23:0] side_color,  // colour of the map's side
    output logic lit,  // 1 where the light is fitted
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] light_x,  // direction towards the light, times the diffuse share, x
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] light_y,  // the same, y
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] light_z,  // the same, z
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] ambient,  // the ambient share
    output logic signed [7:0] ramp_exponent,  // heights times two to this power lie in [0, 1)
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] ramp_gain,  // ramp segments per such height
    output logic [3:0] ramp_last,  // last segment of the ramp
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] mean_red,  // mean of the two colours, red
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] mean_green,  // the same, green
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] mean_blue,  // the same, blue
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] swing_red,  // half of what they differ by, red
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] swing_green,  // the same, green
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] swing_blue,  // the same, blue
    output logic signed [7:0] contrast_exponent,  // power of two on the denominator
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] contrast_gain,  // gain that makes it contrast plus one
    output logic full_from_fitted,  // 1 where some denominator has full contrast
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] full_from  // denominators from this on have full contrast
);
  localparam int CELL = WIDE == 1 ? 26 : 12;

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
        16'(terraline_pkg::ADDRESS_EYE_Y): eye_y <= load_data;
        16'(terraline_pkg::ADDRESS_HIGHEST): highest <= load_data;
        16'(terraline_pkg::ADDRESS_BASE): base <= load_data;
        16'(terraline_pkg::ADDRESS_FINENESS): fineness <= load_data[2:0];
        16'(terraline_pkg::ADDRESS_LAST): last <= load_data[25:0];
        16'(terraline_pkg::ADDRESS_BISECTION_FIXED): bisection_fixed <= load_data[0];
        16'(terraline_pkg::ADDRESS_BISECTION_BIAS): bisection_bias <= load_data[7:0];
        16'(terraline_pkg::ADDRESS_BISECTION_CAP): bisection_cap <= load_data[5:0];
        16'(terraline_pkg::ADDRESS_SKIPPING): skipping <= load_data[0];
        16'(terraline_pkg::ADDRESS_PYRAMID_TOP): pyramid_top <= load_data[4:0];
        16'(terraline_pkg::ADDRESS_BEYOND_SKY): beyond_sky <= load_data[0];
        16'(terraline_pkg::ADDRESS_MAP_COLUMNS): map_columns <= load_data[CELL-1:0];
        16'(terraline_pkg::ADDRESS_MAP_ROWS): map_rows <= load_data[CELL-1:0];
        16'(terraline_pkg::ADDRESS_MAP_EDGE): map_edge <= load_data[1:0];
        16'(terraline_pkg::ADDRESS_SIDES): sides <= load_data[0];
        16'(terraline_pkg::ADDRESS_VOID_BITS): void_bits <= load_data[0];
        16'(terraline_pkg::ADDRESS_FORM): form <= load_data[1:0];
        16'(terraline_pkg::ADDRESS_DEFORMATION_SHIFT): deformation_shift <= load_data[5:0];
        16'(terraline_pkg::ADDRESS_KERNEL_LOG2): kernel_log2 <= load_data[4:0];
        16'(terraline_pkg::ADDRESS_SLOPE_SCALED): slope_scaled <= load_data[0];
        16'(terraline_pkg::ADDRESS_SLOPE_SCALE_X): slope_scale_x <= load_data;
        16'(terraline_pkg::ADDRESS_SLOPE_SCALE_Z): slope_scale_z <= load_data;
        16'(terraline_pkg::ADDRESS_MEMORY_LATENCY): memory_latency <= load_data[6:0];
        16'(terraline_pkg::ADDRESS_SKY_COLOR): sky_color <= load_data[23:0];
        16'(terraline_pkg::ADDRESS_OUT_OF_RANGE_COLOR): out_of_range_color <= load_data[23:0];
        16'(terraline_pkg::ADDRESS_SIDE_COLOR): side_color <= load_data[23:0];
        16'(terraline_pkg::ADDRESS_LIT): lit <= load_data[0];
        16'(terraline_pkg::ADDRESS_LIGHT_X): light_x <= load_data;
        16'(terraline_pkg::ADDRESS_LIGHT_Y): light_y <= load_data;
        16'(terraline_pkg::ADDRESS_LIGHT_Z): light_z <= load_data;
        16'(terraline_pkg::ADDRESS_AMBIENT): ambient <= load_data;
        16'(terraline_pkg::ADDRESS_RAMP_EXPONENT): ramp_exponent <= load_data[7:0];
        16'(terraline_pkg::ADDRESS_RAMP_GAIN): ramp_gain <= load_data;
        16'(terraline_pkg::ADDRESS_RAMP_LAST): ramp_last <= load_data[3:0];
        16'(terraline_pkg::ADDRESS_MEAN_RED): mean_red <= load_data;
        16'(terraline_pkg::ADDRESS_MEAN_GREEN): mean_green <= load_data;
        16'(terraline_pkg::ADDRESS_MEAN_BLUE): mean_blue <= load_data;
        16'(terraline_pkg::ADDRESS_SWING_RED): swing_red <= load_data;
        16'(terraline_pkg::ADDRESS_SWING_GREEN): swing_green <= load_data;
        16'(terraline_pkg::ADDRESS_SWING_BLUE): swing_blue <= load_data;
        16'(terraline_pkg::ADDRESS_CONTRAST_EXPONENT): contrast_exponent <= load_data[7:0];
        16'(terraline_pkg::ADDRESS_CONTRAST_GAIN): contrast_gain <= load_data;
        16'(terraline_pkg::ADDRESS_FULL_FROM_FITTED): full_from_fitted <= load_data[0];
        16'(terraline_pkg::ADDRESS_FULL_FROM): full_from <= load_data;
        default: ;
      endcase
    end
  end
endmodule
