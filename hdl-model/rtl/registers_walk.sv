// Generated from the register table (src/setup/table.rs) and the lists of coefficients
// (src/unit/coefficient.rs) and cycles (src/unit) by `cargo run -p terraline-hdl -- generate`; a
// test compares.

// The coefficients of the stepper. Loaded before `start`, one per cycle.
//
// Never reset, never changed within a frame.
module registers_walk #(
    parameter int WIDE = 0  // words of 64 bits, not 32
) (
    input logic clock,
    input logic load,  // take `load_data` at this edge
    input logic [15:0] load_address,  // terraline_pkg::ADDRESS_..., perhaps of another bank
    input logic [(WIDE == 1 ? 64 : 32)-1:0] load_data,  // in the low bits
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
    output logic sides  // 1 where the map has sides, drawn down to the base
);
  always_ff @(posedge clock) begin
    if (load) begin
      case (load_address)
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
        16'(terraline_pkg::ADDRESS_SIDES): sides <= load_data[0];
        default: ;
      endcase
    end
  end
endmodule
