// One table of the kernel ROM: 2^TABLE_LOG2 + 1 words, read at two entries a cycle.
//
// The last entry has a register of its own, so that the memory is a power of two. What is read in
// a cycle in which the table is loaded is undefined.
module kernel_table #(
    parameter int WIDTH      = 21,  // bits of a word
    parameter int TABLE_LOG2 = 12   // words, as a power of two, without the last one
) (
    input  logic                clock,
    input  logic                load,          // put load_data at load_address
    input  logic [        16:0] load_address,  // entry; those beyond the last one are ignored
    input  logic [   WIDTH-1:0] load_data,
    input  logic [TABLE_LOG2:0] entry_x,       // entry to read, at most 2^TABLE_LOG2
    input  logic [TABLE_LOG2:0] entry_z,
    output logic [   WIDTH-1:0] word_x,        // its word in the cycle after
    output logic [   WIDTH-1:0] word_z
);
  localparam logic [16:0] LAST = 17'(1 << TABLE_LOG2);
  logic [WIDTH-1:0] words[1 << TABLE_LOG2];
  logic [WIDTH-1:0] last, read_x, read_z;
  logic last_x, last_z;

  always_ff @(posedge clock) begin
    if (load && load_address < LAST) words[load_address[TABLE_LOG2-1:0]] <= load_data;
    read_x <= words[entry_x[TABLE_LOG2-1:0]];
    read_z <= words[entry_z[TABLE_LOG2-1:0]];
  end
  always_ff @(posedge clock) begin
    if (load && load_address == LAST) last <= load_data;
    last_x <= entry_x[TABLE_LOG2];
    last_z <= entry_z[TABLE_LOG2];
  end
  assign word_x = last_x ? last : read_x;
  assign word_z = last_z ? last : read_z;
endmodule
