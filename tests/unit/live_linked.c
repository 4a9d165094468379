/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A program that is linked with the module of the live pages, for the list of the members of GSL's archive that this takes
 * (live_sources).
 */
int main(void)
{
    return 0;
}
