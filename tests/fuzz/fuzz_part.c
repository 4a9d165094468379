/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What `fbd-sweep --resume` finds: FILE.part.key and FILE.part. Either they are the two halves of the input,
 * with a line `%%` between; or a table is made, and the input says what becomes of its bytes. What is refused
 * stays as it is; of what is taken, whole rows at the start stay, and only those that were made so.
 */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "claims.h"
#include "fuzz.h"
#include "partial_file.h"

static const char header[] = "run,a [m],x [m],events,status,reason\n";
static const char mark[] = "%%\n"; /* between two halves */
static const char key[] = "fbd 0.1.0\nmodel 12345678\nvary a=1:9:9\n";

struct place {
    char folder[256], table[272], part[280], key[284];
};

static struct place make_place(void)
{
    struct place place;
    const char *folder = getenv("TMPDIR");
    snprintf(place.folder, sizeof place.folder, "%.200s/fbd-fuzz-%ld", folder ? folder : "/tmp",
             (long)getpid());
    snprintf(place.table, sizeof place.table, "%s/table.csv", place.folder);
    snprintf(place.part, sizeof place.part, "%s.part", place.table);
    snprintf(place.key, sizeof place.key, "%s.part.key", place.table);
    mkdir(place.folder, 0700);
    return place;
}

static void clear_place(const struct place *place)
{
    unlink(place->table);
    unlink(place->part);
    unlink(place->key);
    rmdir(place->folder);
}

static void put(const char *path, const char *bytes, size_t length)
{
    FILE *stream = fopen(path, "w");
    if (!stream) return;
    fwrite(bytes, 1, length, stream);
    fclose(stream);
}

/* The bytes of a file, to be freed; NULL when it is not there. */
static char *get(const char *path, size_t *length)
{
    char *bytes = NULL;
    FILE *stream = fopen(path, "r"), *copy = open_memstream(&bytes, length);
    for (int c; stream && (c = getc(stream)) != EOF;) putc(c, copy);
    fclose(copy);
    if (stream) fclose(stream);
    return bytes;
}

static void claim_same(const char *what, const char *path, const char *bytes, size_t length)
{
    size_t now;
    char *found = get(path, &now);
    if (now != length || memcmp(found, bytes, length) != 0) fuzz_fail("%s is not what it was", what);
    free(found);
}

/* Header and `rows` rows are there: the first bytes of what was there before, unless that was nothing. */
static void claim_kept(const struct place *place, const char *before, size_t length, size_t rows)
{
    size_t now, lines = 0;
    char *found = get(place->part, &now);
    for (size_t i = 0; i < now; i++) lines += found[i] == '\n';
    if (now == 0 || found[now - 1] != '\n') fuzz_fail("a torn line is kept");
    if (lines != rows + 1) fuzz_fail("%zu lines for %zu rows", lines, rows);
    if (rows > 0 && (now > length || memcmp(found, before, now) != 0)) fuzz_fail("rows have changed");
    free(found);
}

/* Open with --resume; true when that is granted. */
static bool open_again(const struct place *place, struct partial_file *file)
{
    char *why = NULL;
    enum partial_opening opening = partial_file_open(file, place->table, header, key, true, &why);
    if ((opening == partial_opened) == (why != NULL))
        fuzz_fail("opening %d says `%s`", opening, why ? why : "");
    free(why);
    return opening == partial_opened;
}

static void go_on(const struct place *place, struct partial_file *file)
{
    size_t rows = file->rows;
    char row[100];
    int length = snprintf(row, sizeof row, "%zu,1,2,0,done,\n", rows + 1);
    if (partial_file_write(file, row, (size_t)length) != 0) fuzz_fail("cannot write");
    if (!partial_file_close(file, false)) fuzz_fail("cannot close");
    if (!open_again(place, file)) fuzz_fail("cannot be gone on with for a second time");
    if (file->rows != rows + 1) fuzz_fail("%zu rows of %zu", file->rows, rows + 1);
    if (!partial_file_close(file, true)) fuzz_fail("cannot close");
    if (access(place->table, F_OK) != 0 || access(place->part, F_OK) == 0) fuzz_fail("not renamed");
}

/* ---- what is found */

struct bytes {
    char *data;
    size_t length;
};

/* A table of some rows, as a sweep that was killed leaves it. */
static void make_table(const struct place *place)
{
    enum { rows = 5 };
    struct partial_file file;
    char *why = NULL, row[100];
    if (partial_file_open(&file, place->table, header, key, false, &why) != partial_opened)
        fuzz_fail("no table can be made: %s", why ? why : "");
    for (int i = 1; i <= rows; i++) {
        int length = snprintf(row, sizeof row, "%d,%d,2.5,0,%s\n", i, i, i % 2 ? "done," : "failed,why");
        if (partial_file_write(&file, row, (size_t)length) != 0) fuzz_fail("cannot write");
    }
    partial_file_close(&file, false);
}

/* Four bytes of the input are one change: of which file and how, where (two), and the byte that is put there.
 */
static void damage(struct bytes files[2], const uint8_t *data, size_t size)
{
    for (; size >= 4; data += 4, size -= 4) {
        struct bytes *file = &files[data[0] & 1];
        if (file->length == 0) continue;
        size_t at = (size_t)(data[1] << 8 | data[2]) % file->length;
        if ((data[0] & 6) == 2)
            file->length = at;
        else
            file->data[at] = (char)data[3];
    }
}

static void damage_table(const struct place *place, const uint8_t *data, size_t size, struct bytes *made)
{
    struct bytes files[2], *part = &files[0], *keys = &files[1];
    make_table(place);
    made->data = get(place->part, &made->length);
    part->data = get(place->part, &part->length);
    keys->data = get(place->key, &keys->length);
    damage(files, data, size);
    put(place->part, part->data, part->length);
    put(place->key, keys->data, keys->length);
    free(part->data);
    free(keys->data);
}

static void put_halves(const struct place *place, const char *text, size_t size, const char *middle)
{
    const char *part = middle + strlen(mark);
    put(place->key, text, (size_t)(middle - text));
    put(place->part, part, (size_t)(text + size - part));
}

static void resume(const struct place *place, const struct bytes *made)
{
    struct bytes part, keys;
    struct partial_file file;
    part.data = get(place->part, &part.length);
    keys.data = get(place->key, &keys.length);
    if (open_again(place, &file)) {
        claim_kept(place, made->data ? made->data : part.data, made->data ? made->length : part.length,
                   file.rows);
        go_on(place, &file);
    } else {
        claim_same("the refused part", place->part, part.data, part.length);
        claim_same("the key of a refused part", place->key, keys.data, keys.length);
    }
    free(part.data);
    free(keys.data);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *text = (const char *)data, *middle = size ? memmem(text, size, mark, strlen(mark)) : NULL;
    struct place place = make_place();
    struct bytes made = {0};
    if (middle)
        put_halves(&place, text, size, middle);
    else
        damage_table(&place, data, size, &made);
    resume(&place, &made);
    clear_place(&place);
    free(made.data);
    return 0;
}
