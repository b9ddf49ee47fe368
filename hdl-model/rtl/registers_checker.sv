// Generated from the register table (src/setup/table.rs) and the lists of coefficients
// (src/unit/coefficient.rs) and cycles (src/unit) by `cargo run -p terraline-hdl -- generate`; a
// test compares.

// The coefficients of the checker of a plane. Loaded before `start`, one per cycle.
//
// Never reset, never changed within a frame.
module registers_checker #(
    parameter int WIDE = 0  // words of 64 bits, not 32
) (
    input logic clock,
    input logic load,  // take `load_data` at this edge
    input logic [15:0] load_address,  // terraline_pkg::ADDRESS_..., perhaps of another bank
    input logic [(WIDE == 1 ? 64 : 32)-1:0] load_data,  // in the low bits
    output logic [23:0] sky_color,  // colour where nothing is met
    output logic [23:0] out_of_range_color,  // colour out of range
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
  always_ff @(posedge clock) begin
    if (load) begin
      case (load_address)
        16'(terraline_pkg::ADDRESS_SKY_COLOR): sky_color <= load_data[23:0];
        16'(terraline_pkg::ADDRESS_OUT_OF_RANGE_COLOR): out_of_range_color <= load_data[23:0];
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
