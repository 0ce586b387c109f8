#!/usr/bin/env python3
"""Writes the small images of this folder (all but the JPEG ones and photo.exr, which were
encoded by libjpeg and OpenEXR). Texel i = width * row + column, row 0 on top, of a 5x4 image:
red = 37i+11, green = 91i+30, blue = 151i+200, alpha = 67i+40, each modulo 256; 16-bit
samples are 257v - 3*column, at least 0; grey is 53i+17 modulo 256; index 3i+1 modulo 5."""
import os
import struct
import zlib

W, H = 5, 4
N = W * H
RGB = [((37 * i + 11) % 256, (91 * i + 30) % 256, (151 * i + 200) % 256) for i in range(N)]
ALPHA = [(67 * i + 40) % 256 for i in range(N)]
GREY = [(53 * i + 17) % 256 for i in range(N)]
INDEX = [(3 * i + 1) % 5 for i in range(N)]
PALETTE = [(255, 0, 0), (0, 200, 10), (20, 30, 250), (250, 240, 20), (128, 128, 128)]


def wide(v, i):
    return max(0, 257 * v - 3 * (i % W))


def rows(items):
    return [items[W * y:W * (y + 1)] for y in range(H)]


def save(name, data):
    here = os.path.dirname(os.path.abspath(__file__))
    with open(os.path.join(here, name), "wb") as f:
        f.write(data)


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(name, bits, color, lines, before=b""):
    raw = b"".join(b"\0" + line for line in lines)
    save(name, b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", W, H, bits, color, 0, 0, 0))
         + before + chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))


def pack_bits(values, bits):
    out, held, used = bytearray(), 0, 0
    for v in values:
        held, used = held << bits | v, used + bits
        if used == 8:
            out.append(held)
            held = used = 0
    if used:
        out.append(held << (8 - used))
    return bytes(out)


def pngs():
    plte = chunk(b"PLTE", b"".join(bytes(c) for c in PALETTE))
    png("rgb8.png", 8, 2, [b"".join(bytes(c) for c in r) for r in rows(RGB)])
    png("rgb8-gama.png", 8, 2, [b"".join(bytes(c) for c in r) for r in rows(RGB)],
        chunk(b"gAMA", struct.pack(">I", 55556)))
    png("rgba8.png", 8, 6, [b"".join(bytes(c) + bytes([a]) for c, a in r)
                            for r in rows(list(zip(RGB, ALPHA)))])
    png("rgb16.png", 16, 2, [b"".join(struct.pack(">3H", *(wide(v, i) for v in RGB[i])) for i in r)
                             for r in rows(list(range(N)))])
    png("grey8.png", 8, 0, [bytes(r) for r in rows(GREY)])
    png("grey2.png", 2, 0, [pack_bits([v % 4 for v in r], 2) for r in rows(GREY)])
    png("grey16.png", 16, 0, [b"".join(struct.pack(">H", wide(GREY[i], i)) for i in r)
                              for r in rows(list(range(N)))])
    png("greya8.png", 8, 4, [b"".join(bytes(p) for p in r) for r in rows(list(zip(GREY, ALPHA)))])
    png("palette8.png", 8, 3, [bytes(r) for r in rows(INDEX)],
        plte + chunk(b"tRNS", bytes([255, 128])))
    png("palette4.png", 4, 3, [pack_bits(r, 4) for r in rows(INDEX)], plte)


def gif(name="palette.gif", flags=0, order=range(H)):
    # One clear code, then every index as it is: codes stay at four bits for 8 texels.
    codes, size, table = [(8, 4)], 4, 10
    for i, v in enumerate(v for y in order for v in rows(INDEX)[y]):
        codes.append((v, size))
        if i:
            table += 1
        if table == 1 << size and size < 12:
            size += 1
    codes.append((9, size))
    held, used, data = 0, 0, bytearray()
    for code, bits in codes:
        held |= code << used
        used += bits
        while used >= 8:
            data.append(held & 255)
            held >>= 8
            used -= 8
    if used:
        data.append(held)
    colors = b"".join(bytes(c) for c in PALETTE) + bytes(9)
    body = b"!\xf9\x04\x01\0\0\x03\0" + b"," + struct.pack("<4HB", 0, 0, W, H, flags) + b"\x03"
    save(name, b"GIF89a" + struct.pack("<HHBBB", W, H, 0xF2, 0, 0) + colors + body
         + bytes([len(data)]) + bytes(data) + b"\0;")


def gifs():
    gif()
    gif("palette-interlaced.gif", 0x40, (0, 2, 1, 3))


def bgr(c):
    return bytes(reversed(c))


def run_pack(texels, limit=128):
    """TGA packets: runs where two texels agree, else one raw packet each. Runs end with their row."""
    out, i = b"", 0
    while i < len(texels):
        n = 1
        while i + n < len(texels) and texels[i + n] == texels[i] and n < limit:
            n += 1
        out += bytes([0x80 | (n - 1) if n > 1 else 0]) + texels[i]
        i += n
    return out


def tga(name, kind, depth, data, flags=0, palette=b"", count=0, entry=0):
    save(name, struct.pack("<BBBHHBHHHHBB", 0, 1 if count else 0, kind, 0, count, entry, 0, 0, W, H, depth, flags)
         + palette + data)


def tgas():
    up = lambda items: [x for r in reversed(rows(items)) for x in r]
    tga("rgb24.tga", 2, 24, b"".join(bgr(c) for c in up(RGB)))
    tga("rgba32.tga", 2, 32, b"".join(bgr(c) + bytes([a]) for c, a in zip(RGB, ALPHA)), 0x20)
    five = [(c[0] >> 3) << 10 | (c[1] >> 3) << 5 | c[2] >> 3 | (0x8000 if i % 2 else 0) for i, c in enumerate(RGB)]
    tga("rgba16.tga", 2, 16, b"".join(struct.pack("<H", v) for v in up(five)))
    tga("grey8.tga", 3, 8, bytes(up(GREY)))
    same = [INDEX[i // 2] for i in range(N)]
    tga("palette-rle.tga", 9, 8, b"".join(run_pack([bytes([v]) for v in r]) for r in reversed(rows(same))), 0,
        b"".join(bgr(c) for c in PALETTE), 5, 24)
    tga("rgb24-rle.tga", 10, 24, b"".join(run_pack([bgr(RGB[i // 3 * 3]) for i in r]) for r in rows(list(range(N)))), 0x20)


def pnms():
    text = lambda rows_: "\n".join(" ".join(map(str, r)) for r in rows_) + "\n"
    head = lambda k, m: "P%d\n# comment\n%d %d\n%s" % (k, W, H, "%d\n" % m if m else "")
    flat = lambda items: [[v for c in r for v in c] for r in rows(items)]
    wide3 = [[wide(v, i) for v in RGB[i]] for i in range(N)]
    save("rgb8.ppm", head(6, 255).encode() + b"".join(bytes(c) for c in RGB))
    save("rgb8-text.ppm", (head(3, 255) + text(flat(RGB))).encode())
    save("rgb16.ppm", head(6, 65535).encode() + b"".join(struct.pack(">3H", *c) for c in wide3))
    save("rgb16-text.ppm", (head(3, 65535) + text(flat(wide3))).encode())
    save("grey8.pgm", head(5, 255).encode() + bytes(GREY))
    save("grey16.pgm", head(5, 65535).encode() + b"".join(struct.pack(">H", wide(GREY[i], i)) for i in range(N)))
    save("grey16-text.pgm", (head(2, 65535) + text(rows([wide(GREY[i], i) for i in range(N)]))).encode())
    save("grey100.pgm", (head(2, 100) + text(rows([v * 100 // 255 for v in GREY]))).encode())
    save("grey1000.pgm", (head(2, 1000) + text(rows([v * 1000 // 255 for v in GREY]))).encode())
    save("bits.pbm", (head(1, 0) + text(rows([v % 2 for v in INDEX]))).encode())
    save("bits4.pbm", head(4, 0).encode() + b"".join(pack_bits([v % 2 for v in r], 1) for r in rows(INDEX)))


def bmp(name, depth, compression, data, colors=b"", height=H):
    start = 54 + len(colors)
    save(name, b"BM" + struct.pack("<IHHI", start + len(data), 0, 0, start)
         + struct.pack("<IiiHHIIiiII", 40, W, height, 1, depth, compression, len(data), 2835, 2835, len(colors) // 4, 0)
         + colors + data)


def field(v, bits):
    return v >> (8 - bits)


def fields(name, depth, masks, pixels):
    code = "<H" if depth == 16 else "<I"
    lines = [b"".join(struct.pack(code, v) for v in r) for r in reversed(rows(pixels))]
    data = b"".join(line + bytes(-len(line) % 4) for line in lines)
    extra = struct.pack("<%dI" % len(masks), *masks)
    size = 40 if len(masks) < 4 else 56
    start = 14 + 40 + len(extra)
    save(name, b"BM" + struct.pack("<IHHI", start + len(data), 0, 0, start)
         + struct.pack("<IiiHHIIiiII", size, W, H, 1, depth, 3 if masks else 0, len(data), 2835, 2835, 0, 0)
         + extra + data)


def field_bmps():
    fields("rgb555.bmp", 16, (), [field(r, 5) << 10 | field(g, 5) << 5 | field(b, 5) for r, g, b in RGB])
    fields("rgb565.bmp", 16, (0xF800, 0x07E0, 0x1F),
           [field(r, 5) << 11 | field(g, 6) << 5 | field(b, 5) for r, g, b in RGB])
    fields("argb4444.bmp", 16, (0xF00, 0xF0, 0xF, 0xF000),
           [field(a, 4) << 12 | field(r, 4) << 8 | field(g, 4) << 4 | field(b, 4)
            for (r, g, b), a in zip(RGB, ALPHA)])
    fields("xbgr32.bmp", 32, (0xFF, 0xFF00, 0xFF0000), [r | g << 8 | b << 16 for r, g, b in RGB])


def bmps():
    pad = lambda b: b + bytes(-len(b) % 4)
    colors = b"".join(bgr(c) + b"\0" for c in PALETTE)
    up = lambda items: list(reversed(rows(items)))
    bmp("rgb24.bmp", 24, 0, b"".join(pad(b"".join(bgr(c) for c in r)) for r in up(RGB)))
    bmp("rgb24-top.bmp", 24, 0, b"".join(pad(b"".join(bgr(c) for c in r)) for r in rows(RGB)), height=-H)
    bmp("rgba32.bmp", 32, 0, b"".join(b"".join(bgr(c) + bytes([a]) for c, a in r) for r in up(list(zip(RGB, ALPHA)))))
    bmp("palette8.bmp", 8, 0, b"".join(pad(bytes(r)) for r in up(INDEX)), colors)
    bmp("palette4.bmp", 4, 0, b"".join(pad(pack_bits(r, 4)) for r in up(INDEX)), colors)
    bmp("bits.bmp", 1, 0, b"".join(pad(pack_bits([v % 2 for v in r], 1)) for r in up(INDEX)), colors[:8])
    packed = b""
    for r in up(INDEX):
        packed += bytes([0, 3]) + bytes(r[:3]) + b"\0" + bytes([1, r[3], 1, r[4]]) + b"\0\0"
    bmp("palette-rle8.bmp", 8, 1, packed + b"\0\1", colors)
    packed = b"".join(bytes([0, 5]) + pack_bits(r, 4) + bytes(1) + b"\0\0" for r in up(INDEX))
    bmp("palette-rle4.bmp", 4, 2, packed + b"\0\1", colors)


def iff(name, planes, compression, masking, values, mode=0, palette=True):
    stride = (W + 15) // 16 * 2
    body = b""
    for r in rows(values):
        for k in range(planes):
            line = pack_bits([v >> k & 1 for v in r], 1)
            line += bytes(stride - len(line))
            body += bytes([stride - 1]) + line if compression else line
    part = lambda kind, data: kind + struct.pack(">I", len(data)) + data + bytes(len(data) & 1)
    form = b"ILBM" + part(b"BMHD", struct.pack(">HHhhBBBBHBBhh", W, H, 0, 0, planes, masking, compression, 0, 0, 1, 1, W, H))
    if mode:
        form += part(b"CAMG", struct.pack(">I", mode))
    if palette:
        form += part(b"CMAP", b"".join(bytes(c) for c in PALETTE) + bytes(9))
    save(name, part(b"FORM", form + part(b"BODY", body)))


def iffs():
    iff("palette.iff", 3, 0, 0, INDEX)
    iff("palette-packed.iff", 3, 1, 0, INDEX)
    iff("rgb24.iff", 24, 1, 0, [c[0] | c[1] << 8 | c[2] << 16 for c in RGB], palette=False)
    iff("ham6.iff", 6, 0, 0, [(i % 4) << 4 | (INDEX[i] if i % 4 == 0 else 5 * i % 16) for i in range(N)], 0x800)


def tiff(name, samples, bits, photometric, data, extra=(), order="<"):
    """Uncompressed, one strip."""
    spare = b""
    entries = []

    def add(tag, kind, values):
        nonlocal spare
        size = {3: "H", 4: "I"}[kind]
        raw = struct.pack(order + "%d%s" % (len(values), size), *values)
        entries.append((tag, kind, len(values), raw))

    add(256, 4, [W]); add(257, 4, [H]); add(258, 3, [bits] * samples); add(259, 3, [1])
    add(262, 3, [photometric]); add(273, 4, [0]); add(277, 3, [samples]); add(278, 4, [H])
    add(279, 4, [len(data)]); add(284, 3, [1])
    for e in extra:
        add(*e)
    entries.sort()
    start = 8 + 2 + 12 * len(entries) + 4
    spare, table = b"", b""
    for tag, kind, count, raw in entries:
        if len(raw) > 4:
            place = start + len(spare)
            spare += raw + bytes(len(raw) & 1)
            raw = struct.pack(order + "I", place)
        table += struct.pack(order + "HHI", tag, kind, count) + raw + bytes(4 - len(raw))
    at = start + len(spare)
    key = struct.pack(order + "HHI", 273, 4, 1)
    table = table.replace(key + bytes(4), key + struct.pack(order + "I", at))
    mark = b"II*\0" if order == "<" else b"MM\0*"
    save(name, mark + struct.pack(order + "I", 8) + struct.pack(order + "H", len(entries)) + table + bytes(4) + spare + data)


def tiffs():
    tiff("rgb8.tif", 3, 8, 2, b"".join(bytes(c) for c in RGB))
    tiff("rgba8.tif", 4, 8, 2, b"".join(bytes(v * a // 255 for v in c) + bytes([a]) for c, a in zip(RGB, ALPHA)), [(338, 3, [1])])
    tiff("rgb16.tif", 3, 16, 2, b"".join(struct.pack(">3H", *(wide(v, i) for v in RGB[i])) for i in range(N)), order=">")
    tiff("grey8.tif", 1, 8, 1, bytes(GREY))
    tiff("grey16.tif", 1, 16, 1, b"".join(struct.pack("<H", wide(GREY[i], i)) for i in range(N)))
    colors = PALETTE + [(0, 0, 0)] * 11
    table = [257 * c[k] for k in range(3) for c in colors]
    tiff("palette4.tif", 1, 4, 3, b"".join(pack_bits(r, 4) for r in rows(INDEX)), [(320, 3, table)])
    colors = PALETTE + [(0, 0, 0)] * 251
    tiff("palette8.tif", 1, 8, 3, bytes(INDEX), [(320, 3, [257 * c[k] for k in range(3) for c in colors])])


def hdr():
    flat = b"".join(bytes([c[0], c[1], c[2], 120 + i]) for i, c in enumerate(RGB))
    save("plain.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (H, W) + flat)
    # Rows of 8 and more may be packed: two rows of ten.
    lines = b""
    for y in range(2):
        row = [RGB[i + 10 * y] + (125 + y,) for i in range(10)]
        lines += bytes([2, 2, 0, 10])
        for k in range(3):
            lines += bytes([10]) + bytes(p[k] for p in row)
        lines += bytes([128 + 10, row[0][3]])
    save("packed.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 10\n" + lines)


def exr(name, channels, chunks, tile=None, width=W, height=H):
    """Not compressed. channels: (name, sampling, value(x, y)); chunks: (place in the file's table, rows, columns)."""
    def attribute(key, kind, data):
        return key + b"\0" + kind + b"\0" + struct.pack("<I", len(data)) + data

    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    listed = b"".join(c.encode() + b"\0" + struct.pack("<iBBBBii", 2, 0, 0, 0, 0, s, s) for c, s, _ in channels)
    head = struct.pack("<II", 0x01312F76, 0x202 if tile else 2)
    head += attribute(b"channels", b"chlist", listed + b"\0") + attribute(b"compression", b"compression", b"\0")
    head += attribute(b"dataWindow", b"box2i", box) + attribute(b"displayWindow", b"box2i", box)
    head += attribute(b"lineOrder", b"lineOrder", b"\0") + attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1))
    head += attribute(b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0))
    head += attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1))
    if tile:
        head += attribute(b"tiles", b"tiledesc", struct.pack("<IIB", *tile, 0))
    head += b"\0"
    at, table, body = len(head) + 8 * len(chunks), b"", b""
    for place, ys, xs in chunks:
        data = b"".join(struct.pack("<f", value(x, y)) for y in ys for _, s, value in channels if y % s == 0
                        for x in xs if x % s == 0)
        table += struct.pack("<Q", at + len(body))
        body += place + struct.pack("<i", len(data)) + data
    save(name, head + table + body)


def exrs():
    part = lambda k: lambda x, y: (RGB[W * y + x] + (ALPHA[W * y + x],))[k] / 256
    tiles = [(struct.pack("<4i", i, j, 0, 0), range(3 * j, min(3 * j + 3, H)), range(2 * i, min(2 * i + 2, W)))
             for j in range(2) for i in range(3)]
    exr("tiled.exr", [("A", 1, part(3)), ("B", 1, part(2)), ("G", 1, part(1)), ("R", 1, part(0))], tiles, (2, 3))
    lines = [(struct.pack("<i", y), (y,), range(4)) for y in range(H)]
    exr("luma.exr", [("BY", 2, lambda x, y: -0.25), ("RY", 2, lambda x, y: 0.25 * x + 0.5 * y),
                     ("Y", 1, lambda x, y: (4 * y + x + 1) / 32)], lines, width=4)
    # Single samples of colours that lie outside the cube: readers make what stands alone paler.
    lines = [(struct.pack("<i", y), (y,), range(12)) for y in range(10)]
    exr("saturated.exr", [("BY", 2, lambda x, y: -1 + (5 * x + 3 * y) % 16 / 4), ("RY", 2, lambda x, y: -1 + (x + 7 * y) % 10 / 2),
                          ("Y", 1, lambda x, y: (12 * y + x + 1) / 120)], lines, width=12, height=10)


for make in (pngs, gifs, field_bmps, exrs, tgas, pnms, bmps, iffs, tiffs, hdr):
    make()
