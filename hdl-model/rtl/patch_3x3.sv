// Height and slopes between 3×3 nodes (equations 17 and 18 of docs/mathematics.md; thesis 2.63).
//
// Takes the nodes in four consecutive cycles, as 2×2 blocks: north-west, south-west, north-east,
// south-east (phases 0 to 3). A column of three nodes is complete in each of the phases 1 to 3 and
// goes through one pair of multipliers along z; along x one multiplier takes the outer columns one
// after the other. The fourth block in cycle t gives the results in cycle t + 5. Every sum of two
// products is rounded once. Blocks of tokens that are left before phase 3 do no harm. Words wrap;
// differences of heights are taken to fit a word and not to be its smallest value, which the plan
// proves. Three products, with slopes seven.
module patch_3x3 #(
    parameter int WIDE   = 0,  // 0: 32-bit words, 1: 64-bit words
    parameter int SLOPES = 1   // 1: slopes as well
) (
    input  logic                             clock,
    input  logic                             take,      // a block is there
    input  logic [                      1:0] phase,     // which
    input  logic [(WIDE != 0 ? 64 : 32)-1:0] h1,        // its node (i, j)
    input  logic [(WIDE != 0 ? 64 : 32)-1:0] h2,        // (i, j + 1)
    input  logic [(WIDE != 0 ? 64 : 32)-1:0] h3,        // (i + 1, j)
    input  logic [(WIDE != 0 ? 64 : 32)-1:0] h4,        // (i + 1, j + 1)
    input  logic [   WIDE != 0 ? 24 : 20:0] weight_x,  // phase 0: of the node before, 1: after
    input  logic [   WIDE != 0 ? 24 : 20:0] weight_z,
    input  logic [   WIDE != 0 ? 26 : 22:0] fall_x,    // negated derivative of weight_x, signed
    input  logic [   WIDE != 0 ? 26 : 22:0] fall_z,
    output logic [(WIDE != 0 ? 64 : 32)-1:0] surface,   // five cycles after phase 3
    output logic [(WIDE != 0 ? 64 : 32)-1:0] slope_x,   // −∂y/∂x, height units per cell
    output logic [(WIDE != 0 ? 64 : 32)-1:0] slope_z    // −∂y/∂z
);
  localparam int W = WIDE != 0 ? 64 : 32;
  localparam int POINT = WIDE != 0 ? 24 : 20;
  localparam int T = POINT + 1;  // bits of a weight
  localparam int S = POINT + 3;  // bits of a fall

  // The column that a block completes, with the node kept from the block before.
  logic [W-1:0] kept, north, centre, south;
  always_comb begin
    case (phase)
      2'd2: begin
        north  = h1;
        centre = h2;
        south  = kept;
      end
      2'd3: begin
        north  = kept;
        centre = h3;
        south  = h4;
      end
      default: begin
        north  = kept;
        centre = h1;
        south  = h2;
      end
    endcase
  end

  // Weights stay until the next token's, which come too late to disturb this one.
  logic [T-1:0] weight_x_before, weight_x_after, weight_z_before, weight_z_after;
  logic [W-1:0] difference_north, difference_south, base, base_2;
  logic is_centre, is_centre_2;  // else the column in this stage is an outer one

  always_ff @(posedge clock) begin
    if (take) begin
      case (phase)
        2'd0: kept <= h1;
        2'd1: kept <= h4;
        default: kept <= h3;
      endcase
    end
    if (take && phase == 2'd0) begin
      weight_x_before <= weight_x;
      weight_z_before <= weight_z;
    end
    if (take && phase == 2'd1) begin
      weight_x_after <= weight_x;
      weight_z_after <= weight_z;
    end
    difference_north <= north - centre;
    difference_south <= south - centre;
    base             <= centre;
    base_2           <= base;
    is_centre        <= phase == 2'd2;
    is_centre_2      <= is_centre;
  end

  // Along z.
  logic [W+T-1:0] product_north, product_south;
  logic [W-1:0] column, column_before;
  product #(.A(W), .B(T), .SIGNED(0)) multiplier_north (
      .clock(clock), .a(difference_north), .b(weight_z_before), .result(product_north));
  product #(.A(W), .B(T), .SIGNED(0)) multiplier_south (
      .clock(clock), .a(difference_south), .b(weight_z_after), .result(product_south));
  rounded #(.W(W), .SUM(W + T), .POINT(POINT)) along_z (
      .sum(product_north + product_south), .base(base_2), .result(column));

  // Along x: west minus centre as the centre comes, east minus centre as the east comes.
  logic [W-1:0] difference, base_3, base_4, height;
  logic [T-1:0] weight_3;
  logic [W+T-1:0] product_x, product_west;
  always_ff @(posedge clock) begin
    column_before <= column;
    difference    <= is_centre_2 ? column_before - column : column - column_before;
    weight_3      <= is_centre_2 ? weight_x_before : weight_x_after;
    base_3        <= column_before;
    base_4        <= base_3;
    product_west  <= product_x;
    surface       <= height;
  end
  product #(.A(W), .B(T), .SIGNED(0)) multiplier_x (
      .clock(clock), .a(difference), .b(weight_3), .result(product_x));
  rounded #(.W(W), .SUM(W + T), .POINT(POINT)) along_x (
      .sum(product_west + product_x), .base(base_4), .result(height));

  generate
    if (SLOPES != 0) begin : gen_slopes
      logic [S-1:0] fall_x_before, fall_x_after, fall_z_before, fall_z_after, fall_3;
      logic [W+S-1:0] fall_north, fall_south, fall_x_product, fall_x_west;
      logic [W-1:0] slope, slope_before, difference_z, base_z_3, base_z_4;
      logic [W+T-1:0] product_z, product_z_west;
      logic [W-1:0] result_x, result_z;

      always_ff @(posedge clock) begin
        if (take && phase == 2'd0) begin
          fall_x_before <= fall_x;
          fall_z_before <= fall_z;
        end
        if (take && phase == 2'd1) begin
          fall_x_after <= fall_x;
          fall_z_after <= fall_z;
        end
        slope_before   <= slope;
        difference_z   <= is_centre_2 ? slope_before - slope : slope - slope_before;
        fall_3         <= is_centre_2 ? fall_x_before : fall_x_after;
        base_z_3       <= slope_before;
        base_z_4       <= base_z_3;
        fall_x_west    <= fall_x_product;
        product_z_west <= product_z;
        slope_x        <= result_x;
        slope_z        <= result_z;
      end

      // The slope along z of each column, then its mean along x.
      product #(.A(W), .B(S)) multiplier_fall_north (
          .clock(clock), .a(difference_north), .b(fall_z_before), .result(fall_north));
      product #(.A(W), .B(S)) multiplier_fall_south (
          .clock(clock), .a(difference_south), .b(fall_z_after), .result(fall_south));
      rounded #(.W(W), .SUM(W + S), .POINT(POINT)) slope_of_column (
          .sum(fall_north + fall_south), .base({W{1'b0}}), .result(slope));
      product #(.A(W), .B(T), .SIGNED(0)) multiplier_z (
          .clock(clock), .a(difference_z), .b(weight_3), .result(product_z));
      rounded #(.W(W), .SUM(W + T), .POINT(POINT)) slope_along_z (
          .sum(product_z_west + product_z), .base(base_z_4), .result(result_z));

      // The slope along x of the columns' heights.
      product #(.A(W), .B(S)) multiplier_fall_x (
          .clock(clock), .a(difference), .b(fall_3), .result(fall_x_product));
      rounded #(.W(W), .SUM(W + S), .POINT(POINT)) slope_along_x (
          .sum(fall_x_west + fall_x_product), .base({W{1'b0}}), .result(result_x));
    end else begin : gen_no_slopes
      assign slope_x = '0;
      assign slope_z = '0;
    end
  endgenerate
endmodule
