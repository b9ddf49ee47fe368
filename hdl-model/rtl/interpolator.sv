// The interpolator: surface height and slopes at a place on the ground, by finite functions
// (equations 14 to 18 of docs/mathematics.md; thesis 2.51, 2.52, 2.59 to 2.61, 2.63). SLOPES = 0
// serves the stepper, SLOPES = 1 the hit.
//
// A token is a place. It is read in R cycles, 1 for 2×2 nodes and 4 for 3×3, whose requester holds
// place and tag; the place reaches the memory in the same cycle. With the last read in cycle c, the
// answer comes in cycle c + max(M, KERNEL_LATENCY) + LERP_LATENCY, with slopes two cycles later.
// Tokens may follow each other without a gap and never stall. One that is left before its last read,
// by dropping request_valid or by request_first of another, has no answer. Reset forgets reads under
// way; the memory must forget them too.
//
// Assumed, as the plan proves it: cells fit CELL bits; maps have at most 2^(CELL-1) nodes a side;
// the kernel's weights lie in [0, 1], its slopes in (−4, 4); differences of the nodes of a patch
// are above the smallest word. All else wraps as the emulator's words do. Maps that repeat are not
// built.
module interpolator #(
    parameter int WIDE        = 0,   // 0: 32-bit words, 1: 64-bit words
    parameter int STRETCH     = 0,   // 0: 2×2 nodes, 1: 3×3
    parameter int SLOPES      = 1,   // 1: slopes as well
    parameter int TAG         = 1,   // bits of the tag that goes along
    parameter int TABLE_LOG2  = 12,  // largest kernel table, as a power of two
    parameter int OUTSTANDING = 8    // most reads under way, at least M
) (
    input logic clock,
    input logic reset,

    // Coefficients, constant while anything is under way.
    input logic [                      1:0] form,                // 2×2 nodes: 0 plain, 1 toward the hat, 2 hat
    input logic [                      5:0] deformation_shift,   // of the kernel's difference to the hat
    input logic [                      4:0] table_log2,          // entries of the kernel, 1 to TABLE_LOG2
    input logic [ (WIDE != 0 ? 26 : 12)-1:0] map_columns,        // nodes in x
    input logic [ (WIDE != 0 ? 26 : 12)-1:0] map_rows,           // nodes in z
    input logic                             map_ends,            // the map ends at its edge, else its edge goes on
    input logic                             void_bits,           // nodes may have no data
    input logic                             slope_scaled,        // slopes are scaled
    input logic [(WIDE != 0 ? 64 : 32)-1:0] slope_scale_x,       // height unit over cell size, weight
    input logic [(WIDE != 0 ? 64 : 32)-1:0] slope_scale_z,

    // Kernel tables, loaded before the first token.
    input logic                             load_weight,         // put load_data into the weights
    input logic                             load_slope,          // put load_data into the slopes
    input logic [                     16:0] load_address,        // entry, 0 to 2^table_log2
    input logic [(WIDE != 0 ? 64 : 32)-1:0] load_data,           // weight's format

    // Request.
    input  logic                             request_valid,      // a place is there
    input  logic                             request_first,      // first cycle of its token
    output logic                             request_last,       // this read is the token's last one
    input  logic [(WIDE != 0 ? 64 : 32)-1:0] request_x,          // place, cells
    input  logic [(WIDE != 0 ? 64 : 32)-1:0] request_z,
    input  logic [                  TAG-1:0] request_tag,        // comes back with the answer

    // Height memory: four banks.
    output logic                                   read,         // read the addresses
    output logic [4*(WIDE != 0 ? 25 : 11)-1:0]     read_column,  // bank 0 in the lowest bits
    output logic [4*(WIDE != 0 ? 25 : 11)-1:0]     read_row,
    input  logic                                   data_valid,   // the oldest read's nodes are there
    input  logic [4*(WIDE != 0 ? 64 : 32)-1:0]     data,         // heights, bank 0 lowest
    input  logic [                            3:0] data_void,    // this bank's node has no data

    // Answer.
    output logic                             answer_valid,
    output logic                             answer_exists,      // the surface exists at the place
    output logic [(WIDE != 0 ? 64 : 32)-1:0] answer_surface,     // its height
    output logic [(WIDE != 0 ? 64 : 32)-1:0] answer_slope_x,     // −∂y/∂x; zero where SLOPES is 0
    output logic [(WIDE != 0 ? 64 : 32)-1:0] answer_slope_z,     // −∂y/∂z
    output logic [                  TAG-1:0] answer_tag
);
  localparam int W = WIDE != 0 ? terraline_pkg::WIDE_WIDTH : terraline_pkg::NARROW_WIDTH;
  localparam int POINT = WIDE != 0 ? terraline_pkg::WIDE_POINT : terraline_pkg::NARROW_POINT;
  localparam int CELL = WIDE != 0 ? 26 : 12;
  localparam int LATENCY = terraline_pkg::LERP_LATENCY + (SLOPES != 0 ? terraline_pkg::SLOPE_LATENCY : 0);

  // Cycle c: addresses of nodes and of kernel entries.
  logic [CELL-1:0] cell_x, cell_z;
  logic [CELL+1:0] column, row;
  logic [POINT-1:0] fraction_x, fraction_z, argument_x, argument_z;
  logic [1:0] phase;
  logic on_map, last, mirrored;
  logic [3:0] odd;

  assign cell_x     = request_x[POINT+:CELL];
  assign cell_z     = request_z[POINT+:CELL];
  assign fraction_x = request_x[POINT-1:0];
  assign fraction_z = request_z[POINT-1:0];
  assign read         = request_valid;
  assign request_last = last;

  generate
    if (STRETCH != 0) begin : gen_stretch_address
      // Blocks around the nearest node, whose index is the cell's or one more.
      logic [1:0] next_phase;
      always_ff @(posedge clock) begin
        if (reset || !request_valid) next_phase <= 2'd0;
        else next_phase <= phase + 2'd1;
      end
      assign phase      = request_first ? 2'd0 : next_phase;
      assign last       = phase == 2'd3;
      assign mirrored   = phase[0];
      assign column     = {{2{cell_x[CELL-1]}}, cell_x} + (CELL + 2)'(fraction_x[POINT-1])
                        + (phase[1] ? '0 : '1);
      assign row        = {{2{cell_z[CELL-1]}}, cell_z} + (CELL + 2)'(fraction_z[POINT-1])
                        + (phase[0] ? '0 : '1);
      assign argument_x = {!fraction_x[POINT-1], fraction_x[POINT-2:0]};
      assign argument_z = {!fraction_z[POINT-1], fraction_z[POINT-2:0]};
    end else begin : gen_cell_address
      assign phase      = 2'd3;
      assign last       = 1'b1;
      assign mirrored   = 1'b0;
      assign column     = {{2{cell_x[CELL-1]}}, cell_x};
      assign row        = {{2{cell_z[CELL-1]}}, cell_z};
      assign argument_x = fraction_x;
      assign argument_z = fraction_z;
    end
  endgenerate

  height_memory #(
      .CELL(CELL)
  ) addresses (
      .map_columns(map_columns),
      .map_rows(map_rows),
      .map_ends(map_ends),
      .cell_x(cell_x),
      .cell_z(cell_z),
      .column(column),
      .row(row),
      .on_map(on_map),
      .read_column(read_column),
      .read_row(read_row),
      .odd(odd)
  );

  // Cycles c + 1 and c + 2: weights. They wait for the nodes, or with M = 1 the nodes for them.
  logic [POINT:0] kernel_x, kernel_z, weight_x, weight_z;
  logic [POINT+2:0] kernel_slope_x, kernel_slope_z, fall_x, fall_z;

  kernel_rom #(
      .WIDE(WIDE),
      .TABLE_LOG2(TABLE_LOG2),
      .SLOPES(SLOPES)
  ) rom (
      .clock(clock),
      .table_log2(table_log2),
      .load_weight(load_weight),
      .load_slope(load_slope),
      .load_address(load_address),
      .load_data(load_data),
      .argument_x(argument_x),
      .argument_z(argument_z),
      .mirrored_x(mirrored),
      .mirrored_z(mirrored),
      .weight_x(kernel_x),
      .weight_z(kernel_z),
      .slope_x(kernel_slope_x),
      .slope_z(kernel_slope_z)
  );

  localparam int ASIDE = 7 + TAG;
  logic [2:1] asked;
  logic [ASIDE-1:0] aside_1, aside;  // what goes along with the weights
  always_ff @(posedge clock) begin
    asked   <= reset ? 2'b00 : {asked[1], request_valid};
    aside_1 <= {on_map, odd, phase, request_tag};
    aside   <= aside_1;
  end

  generate
    if (STRETCH != 0) begin : gen_stretch_weight
      // The node before comes in phase 0, the one after, whose slope is mirrored, in phase 1.
      always_ff @(posedge clock) begin
        weight_x <= kernel_x;
        weight_z <= kernel_z;
        fall_x   <= aside_1[TAG] ? kernel_slope_x : -kernel_slope_x;
        fall_z   <= aside_1[TAG] ? kernel_slope_z : -kernel_slope_z;
      end
    end else begin : gen_hat_weight
      logic [POINT-1:0] hat_x, hat_z;
      always_ff @(posedge clock) begin
        hat_x <= fraction_x;
        hat_z <= fraction_z;
      end
      hat_weight #(
          .POINT(POINT)
      ) hat_weight_x (
          .clock(clock),
          .form(form),
          .shift(deformation_shift),
          .fraction(hat_x),
          .kernel(kernel_x),
          .slope(kernel_slope_x),
          .weight(weight_x),
          .fall(fall_x)
      );
      hat_weight #(
          .POINT(POINT)
      ) hat_weight_z (
          .clock(clock),
          .form(form),
          .shift(deformation_shift),
          .fraction(hat_z),
          .kernel(kernel_z),
          .slope(kernel_slope_z),
          .weight(weight_z),
          .fall(fall_z)
      );
    end
  endgenerate

  localparam int ITEM = 2 * (POINT + 1) + 2 * (POINT + 3) + ASIDE;
  logic [ITEM-1:0] fresh, waiting, item;
  logic is_waiting, take;
  assign fresh = {weight_x, weight_z, fall_x, fall_z, aside};
  assign item  = is_waiting ? waiting : fresh;
  queue #(
      .WIDTH(ITEM),
      .DEPTH(OUTSTANDING)
  ) weights (
      .clock(clock),
      .reset(reset),
      .put(asked[2] && (is_waiting || !take)),
      .in_item(fresh),
      .out_valid(is_waiting),
      .out_ready(take),
      .out_item(waiting)
  );

  // Nodes that come before their weights, with M = 1, are held for a cycle.
  logic is_held;
  logic [4*W-1:0] held, nodes;
  logic [3:0] held_void, nodes_void;
  assign take       = (is_held || data_valid) && (is_waiting || asked[2]);
  assign nodes      = is_held ? held : data;
  assign nodes_void = is_held ? held_void : data_void;
  always_ff @(posedge clock) begin
    is_held <= !reset && (take ? is_held && data_valid : is_held || data_valid);
    if (data_valid) begin
      held      <= data;
      held_void <= data_void;
    end
  end

  // Cycle c + N, N = max(M, 2): nodes out of their banks, and what is known of them.
  logic [POINT:0] item_weight_x, item_weight_z;
  logic [POINT+2:0] item_fall_x, item_fall_z;
  logic item_on_map;
  logic [3:0] item_odd;
  logic [1:0] item_phase;
  logic [TAG-1:0] item_tag;
  assign {item_weight_x, item_weight_z, item_fall_x, item_fall_z,
          item_on_map, item_odd, item_phase, item_tag} = item;

  logic [1:0] bank_1, bank_2, bank_3, bank_4;
  logic [W-1:0] h1, h2, h3, h4;
  logic any_void, exists;
  assign bank_1 = {item_odd[2], item_odd[0]};  // west and north
  assign bank_2 = {item_odd[3], item_odd[0]};  // west and south
  assign bank_3 = {item_odd[2], item_odd[1]};  // east and north
  assign bank_4 = {item_odd[3], item_odd[1]};  // east and south
  assign h1 = nodes[{bank_1, {$clog2(W){1'b0}}}+:W];
  assign h2 = nodes[{bank_2, {$clog2(W){1'b0}}}+:W];
  assign h3 = nodes[{bank_3, {$clog2(W){1'b0}}}+:W];
  assign h4 = nodes[{bank_4, {$clog2(W){1'b0}}}+:W];
  assign any_void = nodes_void[bank_1] || nodes_void[bank_2] || nodes_void[bank_3]
      || nodes_void[bank_4];

  generate
    if (STRETCH != 0) begin : gen_patch_3x3
      logic void_before;
      always_ff @(posedge clock) begin
        if (take) void_before <= any_void || (item_phase != 2'd0 && void_before);
      end
      assign exists = item_on_map && !(void_bits && (any_void || void_before));
    end else begin : gen_patch_2x2
      assign exists = item_on_map && !(void_bits && any_void);
    end
  endgenerate

  // Cycles c + N + 1 to c + N + 5.
  logic [W-1:0] surface, slope_x, slope_z;
  generate
    if (STRETCH != 0) begin : gen_3x3
      patch_3x3 #(
          .WIDE(WIDE),
          .SLOPES(SLOPES)
      ) patch (
          .clock(clock),
          .take(take),
          .phase(item_phase),
          .h1(h1),
          .h2(h2),
          .h3(h3),
          .h4(h4),
          .weight_x(item_weight_x),
          .weight_z(item_weight_z),
          .fall_x(item_fall_x),
          .fall_z(item_fall_z),
          .surface(surface),
          .slope_x(slope_x),
          .slope_z(slope_z)
      );
    end else begin : gen_2x2
      patch_2x2 #(
          .WIDE(WIDE),
          .SLOPES(SLOPES)
      ) patch (
          .clock(clock),
          .h1(h1),
          .h2(h2),
          .h3(h3),
          .h4(h4),
          .weight_x(item_weight_x),
          .weight_z(item_weight_z),
          .fall_x(item_fall_x),
          .fall_z(item_fall_z),
          .surface(surface),
          .slope_x(slope_x),
          .slope_z(slope_z)
      );
    end
  endgenerate

  generate
    if (SLOPES != 0) begin : gen_scale
      logic [W-1:0] surface_1, surface_2;
      always_ff @(posedge clock) begin
        surface_1 <= surface;
        surface_2 <= surface_1;
      end
      assign answer_surface = surface_2;
      slope_scale #(
          .WIDE(WIDE)
      ) scale (
          .clock(clock),
          .scaled(slope_scaled),
          .scale_x(slope_scale_x),
          .scale_z(slope_scale_z),
          .slope_x(slope_x),
          .slope_z(slope_z),
          .out_x(answer_slope_x),
          .out_z(answer_slope_z)
      );
    end else begin : gen_no_scale
      assign answer_surface = surface;
      assign answer_slope_x = slope_x;
      assign answer_slope_z = slope_z;
    end
  endgenerate

  // Whether an answer comes, and for which token.
  logic [LATENCY-1:0] valids, existing;
  logic [TAG*LATENCY-1:0] tags;
  always_ff @(posedge clock) begin
    if (reset) valids <= '0;
    else valids <= {valids[LATENCY-2:0], take && item_phase == 2'd3};
    existing <= {existing[LATENCY-2:0], exists};
    tags     <= {tags[TAG*(LATENCY-1)-1:0], item_tag};
  end
  assign answer_valid  = valids[LATENCY-1];
  assign answer_exists = existing[LATENCY-1];
  assign answer_tag    = tags[TAG*LATENCY-1-:TAG];
endmodule
