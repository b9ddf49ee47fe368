// The shader: the colour of a pixel of a height map (equations 23 to 26 of docs/mathematics.md).
//
// The normal is shifted until its largest component is in [1/2, 1], squared and summed, normalised
// through a table of reciprocal square roots and multiplied with the light; the height's place on
// the ramp mixes two colours; colour times light is rounded to a byte. Sky, far and the side of the
// map have constant colours.
//
// Cycles: one item per cycle. An item taken in cycle t is at the output in cycle t + 13 (L = 13:
// twelve stages and the put into the queue); at most D = 14 items are held. The stages, by the
// register that ends them:
//
//   |  light                                    |  colour
// 1 |  magnitudes of the slopes                 |
// 2 |  their leading one                        |  height shifted by the ramp's exponent
// 3 |  normal shifted, light_y shifted          |  rounded
// 4 |  rounded                                  |  height x gain: sums of rows
// 5 |  squares and dot product: sums of rows    |  place on the ramp
// 6 |  their sums                               |  before the ramp, beyond it
// 7 |  entry of the table, read; dot product    |  segment and fraction
// 8 |  the entry's word                         |  colours of the segment, read
// 9 |  dot product x table: sums of rows        |  rise x fraction: sums of rows
// 10|  their sum, rounded                       |  their sum
// 11|  ambient added, limited to one            |  start added
// 12|  colour x light: sums of rows
// 13|  their sum, rounded to bytes; constant colours; into the queue
//
// Ranges, with F = POINT; every multiplier and table is as wide as these ask for:
// - slopes: any word. Normal: |component| <= 1 by (23), F + 2 bits with sign. Its vertical component
//   is a power of two, so its square and its product with the light are shifts.
// - light: |toward| <= 1 per axis (a direction times the diffuse share), 0 <= ambient <= 1.
// - square sum < 3 by (23) and >= 1/4 - 2^-F: entries of the table up to 3 * 2^RSQRT_LOG2; those
//   from 4 * 2^RSQRT_LOG2 on are never read and not held. Table values <= 2, F + 2 bits.
// - dot product: |dot| <= 2.5 and two roundings, F + 3 bits with sign; times the table <= 5.1,
//   F + 4 bits with sign, with the ambient share <= 6.1.
// - height on its way to the ramp: in [-2, 2), F + 2 bits. By (26) it is in [0, 1] over 2x2 nodes, and
//   at most 1.24 over 3x3, whose weights sum to at most 1.111 per axis. Heights of items that meet no
//   surface are arbitrary.
// - gain <= 30 by (26) with up to 15 segments, F + 6 bits with sign; place in [-60, 60].
// - ramp colours are bytes: start 0 .. 255, rise -255 .. 255, start + rise 0 .. 255, no fraction
//   bits. The product with the fraction is exact; the channel is in [0, 255], F + 8 bits.
//
// The two roundings at the end are one: floor((floor((p + 2^(F-1)) / 2^F) + 2^(F-1)) / 2^F) =
// floor((p + 2^(2F-1) + 2^(F-1)) / 2^(2F)). Rounding once before an addition of whole bits is rounding
// the sum: the sums behind products take the half bit and the other addend at once.
//
// Never divides, never stalls inside; tables and coefficients do not change while items are held.
module shader #(
    parameter int WIDE       = 0,   // 0: words of 32 bits, 1: of 64
    parameter int RSQRT_LOG2 = 10,  // table entries per unit, as a power of two; even
    parameter int SEGMENTS   = 15,  // most segments of the ramp, up to 15
    parameter int TAG        = 1,   // bits that go along with an item
    localparam int W = WIDE != 0 ? terraline_pkg::WIDE_WIDTH : terraline_pkg::NARROW_WIDTH
) (
    input logic clock,
    input logic reset, // no items are held

    // Coefficients.
    input logic        [ 23:0] sky_color,            // colours, red in the low byte: nothing is met
    input logic        [ 23:0] far_color,            // out of range
    input logic        [ 23:0] side_color,           // the side of the map
    input logic                lit,            // the light is fitted; without it shade is one
    input logic signed [W-1:0] toward_x,       // direction to the light times diffuse share, x
    input logic signed [W-1:0] toward_y,       // y
    input logic signed [W-1:0] toward_z,       // z
    input logic signed [W-1:0] ambient,        // ambient share
    input logic signed [  7:0] ramp_exponent,  // power of two on heights; beyond 8 bits, its limit
    input logic signed [W-1:0] ramp_gain,      // segments per shifted height
    input logic        [  3:0] ramp_last,      // segments minus one

    // Tables.
    input logic         load_rsqrt,    // write `load_data` to the reciprocal square roots
    input logic         load_ramp,     // write `load_data` to the ramp
    input logic [ 15:0] load_address,  // entry; of the ramp segment*8 + channel*2 + (0 start, 1 rise)
    input logic [W-1:0] load_data,     // tone word

    // Items.
    input  logic                  in_valid,
    output logic                  in_ready,
    input  logic        [    1:0] in_hit,      // 0 sky, 1 surface, 2 side, 3 far
    input  logic signed [  W-1:0] in_surface,  // height above the lowest node
    input  logic signed [  W-1:0] in_slope_x,  // normal, x; its vertical component is one
    input  logic signed [  W-1:0] in_slope_z,  // normal, z
    input  logic        [TAG-1:0] in_tag,      // goes along
    output logic                  out_valid,
    input  logic                  out_ready,
    output logic        [   23:0] out_color,   // sRGB bytes, red in the low byte
    output logic        [    1:0] out_hit,     // as taken
    output logic        [TAG-1:0] out_tag      // as taken
);
  localparam int F = WIDE != 0 ? terraline_pkg::WIDE_POINT : terraline_pkg::NARROW_POINT;
  localparam int STAGES = 12;
  localparam int SHIFT = $clog2(W - F + 1);  // bits of the normal's shift, 1 .. W - F
  localparam int TABLE = 4 << RSQRT_LOG2;  // entries of the table that are held
  localparam int UNIT = RSQRT_LOG2 + 2;  // bits of an entry's number

  // What goes along: valid, outcome and tag.
  logic [STAGES:1] valid;
  logic [TAG+1:0] along[1:STAGES];
  logic take;

  assign take = in_valid && in_ready;

  always_ff @(posedge clock) begin
    if (reset) valid <= '0;
    else valid <= {valid[STAGES-1:1], take};
    along[1] <= {in_hit, in_tag};
    for (int at = 2; at <= STAGES; at++) along[at] <= along[at-1];
  end

  // Light, 1: magnitudes. That of the lowest word is itself, without sign.
  logic signed [W-1:0] slope_x_1, slope_z_1;
  logic [W-1:0] magnitudes_1;

  always_ff @(posedge clock) begin
    slope_x_1 <= in_slope_x;
    slope_z_1 <= in_slope_z;
    magnitudes_1 <= (in_slope_x < 0 ? -in_slope_x : in_slope_x)
                  | (in_slope_z < 0 ? -in_slope_z : in_slope_z);
  end

  // Light, 2: places of the shift, the leading one's place above the point plus one.
  logic signed [W-1:0] slope_x_2, slope_z_2;
  logic signed [7:0] leading;
  logic [SHIFT-1:0] shift_2;

  leading_one #(
      .W(W - F)
  ) leading_slope (
      .word (magnitudes_1[W-1:F]),
      .place(leading)
  );

  always_ff @(posedge clock) begin
    slope_x_2 <= slope_x_1;
    slope_z_2 <= slope_z_1;
    shift_2   <= leading < 1 ? SHIFT'(1) : SHIFT'(leading) + SHIFT'(1);
  end

  // Light, 3: the normal shifted; toward_y times its vertical component 2^-shift.
  logic [F+2:0] x_shifted, z_shifted, y_shifted, x_3, z_3, y_3;
  logic [SHIFT-1:0] shift_3;

  rescale_shift #(
      .IN(W),
      .OUT(F + 2),
      .PLACES(SHIFT)
  ) shift_x (
      .value (slope_x_2),
      .places(shift_2),
      .out   (x_shifted)
  );

  rescale_shift #(
      .IN(W),
      .OUT(F + 2),
      .PLACES(SHIFT)
  ) shift_z (
      .value (slope_z_2),
      .places(shift_2),
      .out   (z_shifted)
  );

  rescale_shift #(
      .IN(F + 2),
      .OUT(F + 2),
      .PLACES(SHIFT)
  ) shift_y (
      .value (toward_y[F+1:0]),
      .places(shift_2),
      .out   (y_shifted)
  );

  always_ff @(posedge clock) begin
    x_3 <= x_shifted;
    z_3 <= z_shifted;
    y_3 <= y_shifted;
    shift_3 <= shift_2;
  end

  // Light, 4: rounded. The vertical component is below the last bit from a shift of F + 1 on: no
  // light from above.
  logic signed [F+1:0] x_4, z_4, light_y_4;
  logic [SHIFT-1:0] shift_4;

  always_ff @(posedge clock) begin
    x_4 <= x_3[F+2:1] + (F + 2)'(x_3[0]);
    z_4 <= z_3[F+2:1] + (F + 2)'(z_3[0]);
    light_y_4 <= 32'(shift_3) > F ? '0 : y_3[F+2:1] + (F + 2)'(y_3[0]);
    shift_4 <= shift_3;
  end

  // Light, 5 and 6: squares and products with the light. The square of the vertical component is
  // 2^-2shift, or nothing below the last bit; beside it stands the half entry of the table's address.
  logic [2*F+3:0] square_x, square_z, square_x_6, square_z_6;
  logic signed [2*F+3:0] dot_x, dot_z, dot_x_6, dot_z_6;
  logic signed [F+1:0] light_y_5, light_y_6;
  logic [SHIFT-1:0] shift_5;
  logic [F-1:0] square_y, square_y_6;

  square #(
      .A(F + 2)
  ) square_of_x (
      .clock(clock),
      .a(x_4),
      .p(square_x)
  );

  square #(
      .A(F + 2)
  ) square_of_z (
      .clock(clock),
      .a(z_4),
      .p(square_z)
  );

  product #(
      .A(F + 2),
      .B(F + 2)
  ) multiply_dot_x (
      .clock(clock),
      .a(x_4),
      .b(toward_x[F+1:0]),
      .result(dot_x)
  );

  product #(
      .A(F + 2),
      .B(F + 2)
  ) multiply_dot_z (
      .clock(clock),
      .a(z_4),
      .b(toward_z[F+1:0]),
      .result(dot_z)
  );

  always_comb begin
    square_y = '0;
    for (int at = 1; at <= F / 2; at++) if (32'(shift_5) == at) square_y[F-2*at] = 1'b1;
    square_y[F-RSQRT_LOG2-1] = 1'b1;
  end

  always_ff @(posedge clock) begin
    light_y_5 <= light_y_4;
    shift_5 <= shift_4;
    square_x_6 <= square_x;
    square_z_6 <= square_z;
    dot_x_6 <= dot_x;
    dot_z_6 <= dot_z;
    light_y_6 <= light_y_5;
    square_y_6 <= square_y;
  end

  // Light, 7 and 8: the table's entry is read, and stands in a register; the dot product.
  localparam logic [F-1:0] HALF = F'(1) << (F - 1);

  logic [F+1:0] rsqrt[TABLE];
  logic [F+1:0] rsqrt_7, rsqrt_8;
  logic [2*F+3:0] square_sum;
  logic [UNIT-1:0] entry;
  logic signed [2*F+3:0] dot;
  logic signed [F+2:0] dot_7, dot_8;

  assign square_sum = square_x_6 + square_z_6 + {4'b0, square_y_6, HALF};
  assign entry = square_sum[2*F+1:2*F-RSQRT_LOG2];
  assign dot = dot_x_6 + dot_z_6 + $signed({{2{light_y_6[F+1]}}, light_y_6, HALF});

  always_ff @(posedge clock) begin
    if (load_rsqrt && 32'(load_address) < TABLE) rsqrt[load_address[UNIT-1:0]] <= load_data[F+1:0];
    rsqrt_7 <= rsqrt[entry];
    rsqrt_8 <= rsqrt_7;
    dot_7   <= dot[2*F+2:F];
    dot_8   <= dot_7;
  end

  // Light, 9 and 10: divided by the length of the normal. Light from behind is none.
  logic signed [2*F+5:0] diffuse;
  logic signed [2*F+5:0] diffuse_half;
  logic lit_9;
  logic [F+2:0] diffuse_10;

  product #(
      .A(F + 3),
      .B(F + 3)
  ) multiply_diffuse (
      .clock(clock),
      .a(dot_8),
      .b($signed({1'b0, rsqrt_8})),
      .result(diffuse)
  );

  assign diffuse_half = diffuse + $signed({{(F + 6) {1'b0}}, HALF});

  always_ff @(posedge clock) begin
    lit_9 <= dot_8 > 0;
    diffuse_10 <= lit_9 ? diffuse_half[2*F+2:F] : '0;
  end

  // Light, 11: shade, at most one.
  localparam logic [F:0] ONE = (F + 1)'(1) << F;

  logic [F+2:0] shade;
  logic [F:0] shade_11;

  assign shade = diffuse_10 + {2'b0, ambient[F:0]};

  always_ff @(posedge clock) shade_11 <= !lit || shade > {2'b0, ONE} ? ONE : shade[F:0];

  // Colour, 1 to 3: the height shifted by the ramp's exponent, and rounded.
  localparam int LEFT = F + 1;  // a shift to the left by more leaves no bit of a height in range

  logic signed [W-1:0] surface_1;
  logic [F+2:0] height, height_2;
  logic signed [F+1:0] height_3;
  logic signed [8:0] places;
  logic [7:0] height_places;  // of coefficients alone, in a register

  assign places = 9'(LEFT) - 9'(ramp_exponent);

  rescale_shift #(
      .IN(W),
      .OUT(F + 2),
      .LEFT(LEFT),
      .PLACES(8)
  ) shift_height (
      .value (surface_1),
      .places(height_places),
      .out   (height)
  );

  always_ff @(posedge clock) begin
    height_places <= places < 0 ? 8'd0 : places[7:0];
    surface_1 <= in_surface;
    height_2  <= height;
    height_3  <= height_2[F+2:1] + (F + 2)'(height_2[0]);
  end

  // Colour, 4 and 5: the place on the ramp, in segments.
  logic signed [2*F+7:0] place;
  logic signed [2*F+7:0] place_half;
  logic signed [F+6:0] place_5;

  product #(
      .A(F + 2),
      .B(F + 6)
  ) multiply_place (
      .clock(clock),
      .a(height_3),
      .b(ramp_gain[F+5:0]),
      .result(place)
  );

  assign place_half = place + $signed({{(F + 8) {1'b0}}, HALF});

  always_ff @(posedge clock) place_5 <= place_half[2*F+6:F];

  // Colour, 6 and 7: segment, and fraction inside it. The end of the ramp is that of its last segment.
  localparam int INDEX = $clog2(SEGMENTS + 1);

  logic signed [6:0] cell_5;
  logic before_6, beyond_6;
  logic [INDEX-1:0] cell_6, segment_7;
  logic [F-1:0] inside_6;
  logic [F:0] fraction_7, fraction_8;

  assign cell_5 = place_5[F+6:F];

  always_ff @(posedge clock) begin
    before_6 <= cell_5 < 0;
    beyond_6 <= cell_5 > $signed({3'b0, ramp_last});
    cell_6 <= cell_5[INDEX-1:0];
    inside_6 <= place_5[F-1:0];
    if (before_6) segment_7 <= '0;
    else segment_7 <= beyond_6 ? ramp_last[INDEX-1:0] : cell_6;
    fraction_7 <= beyond_6 ? ONE : {1'b0, inside_6};
    fraction_8 <= fraction_7;
  end

  // Colour, 8 to 11, and the pixel's channels, 12 and 13.
  logic [23:0] color;

  for (genvar channel = 0; channel < 3; channel++) begin : gen_channel
    logic [7:0] starts[1<<INDEX];
    logic signed [8:0] rises[1<<INDEX];
    logic load;
    logic [7:0] start_8, start_9, start_10;
    logic signed [8:0] rise_8;
    logic signed [F+10:0] risen;
    logic signed [F+8:0] risen_10;
    logic signed [F+8:0] color_11;
    logic signed [2*F+10:0] shaded;
    logic signed [2*F+10:0] nearest;

    assign load = load_ramp && load_address[2:1] == 2'(channel);

    always_ff @(posedge clock) begin
      if (load && !load_address[0]) starts[load_address[3+:INDEX]] <= load_data[F+:8];
      if (load && load_address[0]) rises[load_address[3+:INDEX]] <= load_data[F+:9];
      start_8 <= starts[segment_7];
      rise_8 <= rises[segment_7];
      start_9 <= start_8;
      start_10 <= start_9;
      risen_10 <= risen[F+8:0];
      color_11 <= risen_10 + $signed({1'b0, start_10, {F{1'b0}}});
    end

    product #(
        .A(F + 2),
        .B(9)
    ) multiply_rise (
        .clock(clock),
        .a($signed({1'b0, fraction_8})),
        .b(rise_8),
        .result(risen)
    );

    product #(
        .A(F + 9),
        .B(F + 2)
    ) multiply_shade (
        .clock(clock),
        .a(color_11),
        .b($signed({1'b0, shade_11})),
        .result(shaded)
    );

    // Half of the product's last bit and half a level.
    assign nearest = shaded + $signed({11'b0, HALF, HALF});
    assign color[8*channel+:8] = nearest[2*F+:8];
  end

  // 13: constant colours, and the queue.
  logic [23:0] pixel;
  logic [ 1:0] hit_12;

  assign hit_12 = along[STAGES][TAG+:2];

  always_comb begin
    case (hit_12)
      2'd0: pixel = sky_color;
      2'd1: pixel = color;
      2'd2: pixel = side_color;
      default: pixel = far_color;
    endcase
  end

  queue #(
      .WIDTH(26 + TAG),
      .DEPTH(STAGES + 2)
  ) results (
      .clock(clock),
      .reset(reset),
      .put(valid[STAGES]),
      .in_item({pixel, along[STAGES]}),
      .out_valid(out_valid),
      .out_ready(out_ready),
      .out_item({out_color, out_hit, out_tag})
  );

  credit #(
      .COUNT(4)
  ) items (
      .clock(clock),
      .reset(reset),
      .depth(4'(terraline_pkg::SHADER_DEPTH)),
      .enter(take),
      .leave(out_valid && out_ready),
      .room(in_ready)
  );
endmodule
