// How a walk ends: in which cycle, with which outcome, and where.
//
// Before it has begun, behind a jump or a sample that is the last one or beyond which nothing can be met,
// or with a hit. A hit is between a clear place and the middle of the last bisection step. Where the clear
// place is beside the map or in a hole, the ray has come through a side, down to the base.
module walk_end #(
    parameter int W     = 32,  // bits of a word
    parameter int POINT = 20,  // bits after the point
    parameter int CELL  = 12   // bits of a cell's index
) (
    // Coefficients
    input  logic signed [   W-1:0] base,             // base of the block under the map
    input  logic        [    25:0] last,             // index of the last sample
    input  logic                   beyond_sky,       // out of range is sky
    input  logic signed [CELL-1:0] east,             // cells in x
    input  logic signed [CELL-1:0] south,            // cells in z
    input  logic                   map_ends,         // the map ends at its edge
    input  logic                   void_bits,        // nodes may have no data
    // What the stepper does in this cycle
    input  logic                   starts,           // starts a walk
    input  logic                   waits,            // waits for a bound
    input  logic                   streams,          // a burst of samples streams
    input  logic                   places,           // places a hit
    // The walk
    input  logic        [     1:0] entry,            // 0 met, 1 sky, 2 out of range
    input  logic                   falls,            // the ray does not rise
    input  logic                   place_over,       // nothing can be met from its start on
    input  logic                   bounded,          // the bound is there
    input  logic                   clear,            // and allows the jump
    input  logic                   ahead_over,       // nothing can be met behind the jump
    input  logic                   answered,         // a sample is answered
    input  logic                   hits,             // it hits
    input  logic                   answer_exists,    // there is a surface
    input  logic                   tag_last,         // it is the last of its burst
    input  logic                   tag_over,         // nothing can be met from there on
    input  logic        [    25:0] remaining,        // samples up to the last one
    input  logic        [    25:0] remaining_next,   // behind one more sample
    input  logic        [    25:0] remaining_ahead,  // behind the jump
    // Places
    input  logic signed [   W-1:0] place_x,          // clear, x
    input  logic signed [   W-1:0] place_z,          // z
    input  logic signed [   W-1:0] ahead_x,          // behind the jump, x
    input  logic signed [   W-1:0] ahead_z,          // z
    input  logic signed [   W-1:0] follow_x,         // the sample, or the middle, x
    input  logic signed [   W-1:0] follow_z,         // z
    input  logic signed [   W-1:0] met_x,            // the last hit, x
    input  logic signed [   W-1:0] met_y,            // y
    input  logic signed [   W-1:0] met_z,            // z
    input  logic                   clear_exists,     // there is a surface at the clear place: of its nodes
    input  logic                   middle_exists,    // and at the middle
    // The end
    output logic                   put,              // it is there
    output logic        [     1:0] put_hit,          // 0 sky, 1 surface, 2 side, 3 out of range
    output logic signed [   W-1:0] put_x,            // place, x
    output logic signed [   W-1:0] put_z,            // z
    output logic        [    25:0] put_steps         // samples passed
);
  localparam logic [1:0] SKY = 2'd0, SURFACE = 2'd1, SIDE = 2'd2, OUT_OF_RANGE = 2'd3;
  localparam logic [1:0] ENTRY_MET = 2'd0, ENTRY_OUT_OF_RANGE = 2'd2;

  logic signed [CELL-1:0] clear_i, clear_j, middle_i, middle_j;
  logic clear_on_map, middle_on_map;
  logic clear_there, middle_there;
  logic under_base;

  assign clear_i = place_x[POINT+:CELL];
  assign clear_j = place_z[POINT+:CELL];
  assign middle_i = follow_x[POINT+:CELL];
  assign middle_j = follow_z[POINT+:CELL];
  assign clear_on_map = !map_ends
      || (clear_i >= 0 && clear_i < east && clear_j >= 0 && clear_j < south);
  assign middle_on_map = !map_ends
      || (middle_i >= 0 && middle_i < east && middle_j >= 0 && middle_j < south);
  assign clear_there = void_bits ? clear_exists : clear_on_map;
  assign middle_there = void_bits ? middle_exists : middle_on_map;
  // A ray that does not rise meets nothing below the base.
  assign under_base = falls && met_y < base;

  always_comb begin
    put = 1'b0;
    put_hit = SKY;
    put_x = place_x;
    put_z = place_z;
    put_steps = last - remaining;
    if (starts) begin
      put_steps = '0;
      if (entry != ENTRY_MET) begin
        put = 1'b1;
        put_hit = entry == ENTRY_OUT_OF_RANGE && !beyond_sky ? OUT_OF_RANGE : SKY;
      end else if (place_over) begin
        put = 1'b1;
      end else if (last == '0) begin
        put = 1'b1;
        put_hit = OUT_OF_RANGE;
      end
    end else if (waits) begin
      put_x = ahead_x;
      put_z = ahead_z;
      put_steps = last - remaining_ahead;
      put_hit = ahead_over ? SKY : OUT_OF_RANGE;
      put = bounded && clear && (ahead_over || remaining_ahead == '0);
    end else if (streams) begin
      put_x = follow_x;
      put_z = follow_z;
      put_steps = last - remaining_next;
      put_hit = tag_over ? SKY : OUT_OF_RANGE;
      put = answered && !hits
          && (tag_last ? tag_over || remaining_next == '0 : tag_over && !answer_exists);
    end else if (places) begin
      put = 1'b1;
      if (clear_there) put_hit = SURFACE;
      // From beside the map or out of a hole: the side, down to the base.
      else put_hit = under_base ? SKY : SIDE;
      put_x = clear_there && middle_there ? follow_x : met_x;
      put_z = clear_there && middle_there ? follow_z : met_z;
    end
  end
endmodule
