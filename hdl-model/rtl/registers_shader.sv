// Generated from the register table (src/setup/table.rs) and the lists of coefficients
// (src/unit/coefficient.rs) and cycles (src/unit) by `cargo run -p terraline-hdl -- generate`; a
// test compares.

// The coefficients of the shader of a height map. Loaded before `start`, one per cycle.
//
// Never reset, never changed within a frame.
module registers_shader #(
    parameter int WIDE = 0  // words of 64 bits, not 32
) (
    input logic clock,
    input logic load,  // take `load_data` at this edge
    input logic [15:0] load_address,  // terraline_pkg::ADDRESS_..., perhaps of another bank
    input logic [(WIDE == 1 ? 64 : 32)-1:0] load_data,  // in the low bits
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
    output logic [3:0] ramp_last  // last segment of the ramp
);
  always_ff @(posedge clock) begin
    if (load) begin
      case (load_address)
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
        default: ;
      endcase
    end
  end
endmodule
