// Generated from the register table (src/setup/table.rs) and the lists of coefficients
// (src/unit/coefficient.rs) and cycles (src/unit) by `cargo run -p terraline-hdl -- generate`; a
// test compares.

// The coefficients of a height map, its kernel and its memory. Loaded before `start`, one per cycle.
//
// Never reset, never changed within a frame.
module registers_map #(
    parameter int WIDE = 0  // words of 64 bits, not 32
) (
    input logic clock,
    input logic load,  // take `load_data` at this edge
    input logic [15:0] load_address,  // terraline_pkg::ADDRESS_..., perhaps of another bank
    input logic [(WIDE == 1 ? 64 : 32)-1:0] load_data,  // in the low bits
    output logic [(WIDE == 1 ? 26 : 12)-1:0] map_columns,  // nodes of the map in x
    output logic [(WIDE == 1 ? 26 : 12)-1:0] map_rows,  // nodes of the map in z
    output logic [1:0] map_edge,  // beyond the edge: 0 the map ends, 1 its edge nodes go on, 2 it repeats
    output logic void_bits,  // 1 where nodes may have no data
    output logic [1:0] form,  // weights: 0 the kernel's, 1 toward the hat's, 2 the hat's, 3 over 3x3 nodes
    output logic [5:0] deformation_shift,  // places that the difference to the hat is shifted right
    output logic [4:0] kernel_log2,  // the kernel tables have 2^log2 entries a cell, and one
    output logic slope_scaled,  // 1 where slopes have factors
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] slope_scale_x,  // factor on a slope, x: height unit over cell
    output logic signed [(WIDE == 1 ? 64 : 32)-1:0] slope_scale_z,  // the same, z
    output logic [6:0] memory_latency  // M: cycles from address to data
);
  localparam int CELL = WIDE == 1 ? 26 : 12;

  always_ff @(posedge clock) begin
    if (load) begin
      case (load_address)
        16'(terraline_pkg::ADDRESS_MAP_COLUMNS): map_columns <= load_data[CELL-1:0];
        16'(terraline_pkg::ADDRESS_MAP_ROWS): map_rows <= load_data[CELL-1:0];
        16'(terraline_pkg::ADDRESS_MAP_EDGE): map_edge <= load_data[1:0];
        16'(terraline_pkg::ADDRESS_VOID_BITS): void_bits <= load_data[0];
        16'(terraline_pkg::ADDRESS_FORM): form <= load_data[1:0];
        16'(terraline_pkg::ADDRESS_DEFORMATION_SHIFT): deformation_shift <= load_data[5:0];
        16'(terraline_pkg::ADDRESS_KERNEL_LOG2): kernel_log2 <= load_data[4:0];
        16'(terraline_pkg::ADDRESS_SLOPE_SCALED): slope_scaled <= load_data[0];
        16'(terraline_pkg::ADDRESS_SLOPE_SCALE_X): slope_scale_x <= load_data;
        16'(terraline_pkg::ADDRESS_SLOPE_SCALE_Z): slope_scale_z <= load_data;
        16'(terraline_pkg::ADDRESS_MEMORY_LATENCY): memory_latency <= load_data[6:0];
        default: ;
      endcase
    end
  end
endmodule
