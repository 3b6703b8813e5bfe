// The font file as bytes of the program: hiac_font_begin ... hiac_font_end.
    .section .rodata
    .global hiac_font_begin
    .global hiac_font_end
    .balign 16
hiac_font_begin:
    .incbin HIAC_FONT
hiac_font_end:
    .byte 0
    .section .note.GNU-stack, "", %progbits
